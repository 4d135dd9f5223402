// Case 2: what no pair force may change. Both precisions, whatever the knobs say.
#include <array>
#include <cmath>
#include <string>

#include "service/lab/validation/case_world.h"
#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

using sph::Precision;
using sph::Vec3;

struct Width {
  Precision precision;
  const char* name;
};
constexpr std::array kWidths{Width{Precision::float32, "float"}, Width{Precision::float64, "double"}};

constexpr double kSpacing = 0.001;  // m

Knobs withPrecision(const Knobs& knobs, Precision precision) {
  Knobs own = knobs;
  own.precision = precision;
  return own;
}

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// Sum of m x cross v and of its magnitudes, kg m^2/s.
struct AngularMomentum {
  Vec3 sum = Vec3::Zero();
  double scale = 0.0;
};
AngularMomentum angularMomentum(const sph::World& world) {
  const Frame frame = frameOf(world);
  AngularMomentum whole;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec3 own = world.particleMass() * cross(frame.position(i), frame.velocity(i));
    whole.sum += own;
    whole.scale += own.norm();
  }
  return whole;
}

void addFluid(sph::WorldDescription& scene) {
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace();
}

/// Two blocks of different viscosity that collide off centre and spin: relative to sum m |v|.
Status collide(const Knobs& knobs, const Width& width, CaseResult& result) {
  sph::WorldDescription scene = emptyScene(knobs, kSpacing, 0.5);
  addFluid(scene);
  scene.domain.lower = Vec3::Constant(-0.05);
  scene.domain.upper = Vec3::Constant(0.05);
  const Vec3 half = Vec3::Constant(4.0 * kSpacing);
  addBlock(scene, Vec3{-0.0045, -0.002, 0} - half, {8, 8, 8});
  scene.fluid_blocks.back().velocity = {0.3, 0.05, 0.0};
  addBlock(scene, Vec3{0.0045, 0.002, 0} - half, {8, 8, 8});
  scene.fluid_blocks.back().velocity = {-0.2, -0.1, 0.02};
  scene.fluid_blocks.back().viscosity = 0.05;
  for (sph::FluidBlock& block : scene.fluid_blocks) block.jitter = 0.1;
  auto world = CaseWorld::create(scene, withPrecision(knobs, width.precision), result.cost);
  if (!world) return world.status();
  const sph::WorldStats before = world->stats();
  const double scale = momentumScale(**world, frameOf(**world).buffer);
  if (Status status = world->runFor(0.05); !status.ok()) return status;
  const sph::WorldStats after = world->stats();
  if (!(after.kinetic_energy < 0.9 * before.kinetic_energy)) return {StatusCode::internal, "the blocks did not meet"};
  const double bound = width.precision == Precision::float64 ? 1e-10 : 1e-6;
  result.figures.push_back(
      residual(std::string{"momentum_"} + width.name, (after.momentum - before.momentum).norm() / scale, bound));
  return {};
}

/// A turning block of thick blood is a rigid body: the central form of the implicit solve takes neither its momentum nor its
/// angular momentum. What is left is the solve's residual and, in float, the rounding of dt D v, whose terms are far larger than
/// their sum: 1.2e-8 a step from a tolerance of 1e-7 on down to 1e-9, always to the same side, hence 50 steps. The angular
/// momentum is that of frames, which are float in either: 2e-8.
Status turn(const Knobs& knobs, const Width& width, CaseResult& result) {
  const bool twice = width.precision == Precision::float64;
  sph::WorldDescription scene = emptyScene(knobs, kSpacing, 0.5);
  scene.domain.lower = Vec3::Constant(-0.05);
  scene.domain.upper = Vec3::Constant(0.05);
  sph::ViscositySettings& viscosity = scene.effects.viscosity.emplace();
  viscosity.viscosity = 10.0;
  viscosity.solve = sph::ViscositySolve::implicit;
  viscosity.solve_tolerance = twice ? 1e-12 : 1e-7;
  addBlock(scene, -kSpacing * Vec3{5.0, 5.0, 3.0}, {10, 10, 6});
  scene.fluid_blocks.back().jitter = 0.1;
  const double rate = 5.0;  // 1/s: 0.03 m/s at the corners
  setFlow(scene, 2, [rate](const Vec3& at) -> Vec3 { return {-rate * at.y(), rate * at.x(), 0.01}; });
  auto world = CaseWorld::create(scene, withPrecision(knobs, width.precision), result.cost);
  if (!world) return world.status();
  const AngularMomentum before = angularMomentum(**world);
  const Vec3 momentum = world->stats().momentum;
  const double scale = momentumScale(**world, frameOf(**world).buffer);
  for (int k = 0; k < 50; ++k) {
    if (Status status = world->step(1.0); !status.ok()) return status;
  }
  const sph::WorldStats stats = world->stats();
  if (stats.viscosity_iterations <= 5 || world->counter(sph::Counter::viscosity_unsolved) > 0)
    return {StatusCode::internal, "the implicit solve did no work, or not all of it"};
  result.figures.push_back(residual(std::string{"angular_momentum_"} + width.name,
                                    (angularMomentum(**world).sum - before.sum).norm() / before.scale, 1e-6));
  result.figures.push_back(
      residual(std::string{"thick_momentum_"} + width.name, (stats.momentum - momentum).norm() / scale, twice ? 1e-10 : 1e-6));
  return {};
}

}  // namespace

// Exact for kick-drift-kick under a constant acceleration. A rest lattice has p = 0 to the rounding of its density sums, and what
// is left cancels in the centre of mass.
Result<CaseResult> runFreeFall(const Knobs& knobs) {
  CaseResult result;
  for (const Width& width : kWidths) {
    sph::WorldDescription scene = emptyScene(knobs, kSpacing, 0.5);
    addFluid(scene);
    scene.effects.gravity.emplace();
    scene.domain.lower = {-0.05, -0.05, -0.4};
    scene.domain.upper = Vec3::Constant(0.05);
    addBlock(scene, Vec3::Constant(-3.0 * kSpacing), {6, 6, 6});
    auto world = CaseWorld::create(scene, withPrecision(knobs, width.precision), result.cost);
    if (!world) return world.status();
    const double start = world->stats().center.z();
    if (Status status = world->runFor(0.25); !status.ok()) return status;
    const double t = (*world)->time();
    const sph::WorldStats stats = world->stats();
    const double bound = width.precision == Precision::float64 ? 1e-9 : 2e-4;
    result.figures.push_back(
        compared(std::string{"fall_"} + width.name, start - stats.center.z(), 0.5 * kGravity * t * t, bound, "m"));
    result.figures.push_back(compared(std::string{"speed_"} + width.name,
                                      -stats.momentum.z() / (stats.particles * (*world)->particleMass()), kGravity * t, bound,
                                      "m/s"));
  }
  return result;
}

Result<CaseResult> runSpinningBlob(const Knobs& knobs) {
  CaseResult result;
  for (const Width& width : kWidths) {
    if (Status status = collide(knobs, width, result); !status.ok()) return status;
    if (Status status = turn(knobs, width, result); !status.ok()) return status;
  }
  return result;
}

}  // namespace bleedsim::lab
