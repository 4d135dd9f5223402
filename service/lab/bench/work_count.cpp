#include "service/lab/bench/work_count.h"

#include <algorithm>
#include <variant>

#include "service/sph/world_setup.h"

namespace bleedsim::lab {
namespace {

constexpr double kNumber = 4.0;       // bytes of a number and of an entry
constexpr double kListPlace = 5.0;    // bytes: where a particle's list is, and how long
constexpr double kAcceleration = 16;  // bytes

// Of a pair: offset (3) and squared distance (1; the distance stands in the list).
constexpr double kGeometry = 4.0;
// Of a candidate: against the box of a cell (12 of the distance, 6 of its square, 1 compare); against a particle.
constexpr double kBoxTest = 19.0;
constexpr double kDistanceTest = 9.0;

bool isLiteral(const sph::WorldDescription& scene) { return scene.model == sph::Model::literal; }
bool hasOwnRadii(const sph::WorldDescription& scene) { return scene.effects.core_radius.has_value(); }

/// W from q^2, with the root that the lists keep; its gradient from q.
double weightFlops(const sph::WorldDescription& scene) {
  if (isLiteral(scene)) return 4.0;                                   // poly6: 1 - q2, max, u u u
  return scene.kernel == sph::KernelType::cubic_spline ? 12.0 : 8.0;  // root, two pieces; root, t, t^4 (5 - 4t)
}
double gradientFlops(const sph::WorldDescription& scene) {
  if (isLiteral(scene)) return 6.0;                                  // spiky: t, t^2, 1/q
  return scene.kernel == sph::KernelType::cubic_spline ? 8.0 : 4.0;  // t, t^3
}

/// Both kernels of a pair with radii of their own, their factors and mean, for density.
double densityPairFlops(const sph::WorldDescription& scene) {
  const double weight = weightFlops(scene);
  if (!hasOwnRadii(scene)) return weight + 1.0;
  if (isLiteral(scene)) return weight + 3.0;
  return 2.0 * (weight + 1.0) + 6.0;
}

double pressureFlops(sph::PressureTerm term) {
  if (term == sph::PressureTerm::none) return 0.0;
  return term == sph::PressureTerm::symmetric ? 10.0 : 8.0;
}

/// With the pressure from the neighbour's density.
double literalPressureFlops(sph::PressureTerm term) {
  if (term == sph::PressureTerm::none) return 0.0;
  return term == sph::PressureTerm::symmetric ? 12.0 : 11.0;
}

double literalPairFlops(const sph::WorldDescription& scene) {
  const sph::LiteralSet set = sph::literalSet(scene);
  double flops = kGeometry + gradientFlops(scene) + (set.core_radius ? 3.0 : 0.0) + literalPressureFlops(set.pressure);
  if (set.tension) flops += 13.0;  // colour gradient and Laplacian
  if (set.viscosity) flops += 11.0;
  if (set.platelets) flops += 5.0;
  if (set.repulsion) flops += 18.0 + scene.literal.power_1 + scene.literal.power_2;
  return flops;
}

/// Geometry and the gradient that the sound model's pairs share.
double soundGradientFlops(const sph::WorldDescription& scene) {
  return kGeometry + (hasOwnRadii(scene) ? 2.0 * (gradientFlops(scene) + 2.0) + 2.0 : gradientFlops(scene));
}

/// Curvature tension: normals along with the forces, then a sweep for surface particles only.
double tensionFlops(const sph::WorldDescription& scene, const Census& census) {
  const double gradient = soundGradientFlops(scene);
  return census.listed * (6.0 + census.surface * (gradient + densityPairFlops(scene) - 2.0 + 30.0));
}

double sweepBytes(const Census& census, double record) { return record + 2.0 * census.listed * kNumber + kListPlace; }

Work forceWork(const sph::WorldDescription& scene, const Census& census, double record, int iterations) {
  const bool literal = isLiteral(scene);
  Work work{census.listed * pairFlops(scene, iterations > 0), sweepBytes(census, record) + kAcceleration};
  if (literal) return work;
  const auto& viscosity = scene.effects.viscosity;
  if (viscosity && !std::holds_alternative<sph::NewtonianRheology>(viscosity->rheology)) {
    work += {census.listed * (soundGradientFlops(scene) + 38.0), sweepBytes(census, record) + 64.0};
  }
  if (scene.effects.surface_tension) {
    work += {tensionFlops(scene, census), census.surface * sweepBytes(census, record) + 3.0 * kAcceleration};
  }
  return work;
}

/// Of one product of the implicit viscosity.
Work productWork(const sph::WorldDescription& scene, const Census& census, double record) {
  const double harmonic = sph::viscosityVaries(scene) ? 2.0 : 0.0;
  return {census.listed * (soundGradientFlops(scene) + 22.0 + harmonic), sweepBytes(census, record) + 4.0 * kAcceleration};
}

double stateBytes(const sph::WorldDescription& scene) {
  const auto fields = sph::particleFields<float>(scene);
  const int optional = int(fields.viscosity) + int(fields.platelet) + int(fields.radius) + int(fields.own_viscosity);
  return kNumber * (8 + optional);  // place, velocity, id, driver
}

int recordGroupsOf(const sph::WorldDescription& scene) {
  const sph::PairLayout layout = sph::pairLayout(scene);
  return std::max(layout.least_groups, sph::recordGroups(layout.set));
}

}  // namespace

double pairFlops(const sph::WorldDescription& scene, bool implicit_viscosity) {
  if (isLiteral(scene)) return literalPairFlops(scene);
  const sph::PairSet set = sph::pairSet(scene);
  double flops = soundGradientFlops(scene) + pressureFlops(set.pressure);
  if (!implicit_viscosity && set.viscosity == sph::ViscosityTerm::uniform) flops += 14.0;
  if (!implicit_viscosity && set.viscosity == sph::ViscosityTerm::harmonic) flops += 16.0;
  if (set.repulsion) flops += 31.0 + scene.effects.repulsion->power_1 + scene.effects.repulsion->power_2;
  return flops;
}

StageWork workOf(const sph::WorldDescription& scene, const Census& census, int solver_iterations) {
  const double state = stateBytes(scene);
  const double record = 16.0 * recordGroupsOf(scene);
  const double place = 3.0 * kNumber;
  const double velocity = 3.0 * kNumber;
  StageWork stages{};
  const auto at = [&stages](sph::Stage stage) -> Work& { return stages[static_cast<std::size_t>(stage)]; };
  // Half a kick and the drift (4 a coordinate), bounds and sides (4 a coordinate); places in, moved ones and cells out.
  at(sph::Stage::move) = {24.0, place + velocity + kNumber + kAcceleration + 16.0 + kNumber};
  // The cell (5 a coordinate) and half a kick (2); cells three times, moved places, accelerations, the old state in, the new one
  // and the record out.
  at(sph::Stage::neighbors) = {21.0, 2.0 * 16.0 + kAcceleration + 4.0 * kNumber + 2.0 * state + record};
  const double tissue = scene.tissue.empty() ? 0.0 : 1.0;
  at(sph::Stage::density) = {
      census.boxed * kBoxTest + census.candidates * kDistanceTest + census.listed * densityPairFlops(scene) + 8.0 + 2.0 * tissue,
      place + tissue * kNumber + 2.0 * census.listed * kNumber + kListPlace + 2.0 * kNumber + kNumber};
  at(sph::Stage::force) = forceWork(scene, census, record, solver_iterations);
  // Gravity, the kick, both squares and bounds.
  at(sph::Stage::integrate) = {24.0, 2.0 * velocity + 2.0 * kAcceleration + kNumber};
  for (int k = 0; k < solver_iterations; ++k) at(sph::Stage::integrate) += productWork(scene, census, record);
  return stages;
}

Work totalOf(const StageWork& stages) {
  Work total;
  for (const Work& stage : stages) total += stage;
  return total;
}

}  // namespace bleedsim::lab
