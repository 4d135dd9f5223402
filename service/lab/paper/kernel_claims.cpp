// What the paper says of its kernels, on small bodies of particles summed pair by pair. Lengths in spacings, masses in rho0 dx^3,
// the speed of sound is 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "service/lab/paper/claims.h"
#include "service/lab/paper/paper_scene.h"
#include "service/sph/seeding.h"

namespace bleedsim::lab {
namespace {

using Vec3 = sph::Vec3;
using Cloud = std::vector<Vec3>;

// Of the settling, which no scene can say. Pressure acts everywhere in a cube that is a quarter denser than at rest; the loss
// ends every motion within the run.
constexpr double kRest = 0.8;         // rest density over the lattice's
constexpr double kKept = 0.95;        // of the velocity, a step
constexpr double kNear = 0.4;         // support radii between the two particles of the viscous pair
constexpr double kPercentile = 0.01;  // of the nearest distances

Cloud jitteredCube(const KernelCube& cube, sph::JitterSource& jitter) {
  Cloud cloud;
  for (int x = 0; x < cube.side; ++x) {
    for (int y = 0; y < cube.side; ++y) {
      for (int z = 0; z < cube.side; ++z) {
        Vec3& position = cloud.emplace_back(double(x), double(y), double(z));
        for (Eigen::Index a = 0; a < 3; ++a) position[a] += cube.jitter * jitter.next();
      }
    }
  }
  return cloud;
}

/// Calls pair(i, j, x_i - x_j, r) for every pair nearer than `reach`, across the sides too.
template <class Consume>
void forPairs(const Cloud& cloud, int side, double reach, Consume&& pair) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t j = i + 1; j < cloud.size(); ++j) {
      Vec3 apart = cloud[i] - cloud[j];
      for (Eigen::Index a = 0; a < 3; ++a) apart[a] -= side * std::round(apart[a] / side);
      const double r = apart.norm();
      if (r < reach) pair(i, j, apart, r);
    }
  }
}

/// First percentile of the nearest distances after a damped fall into rest under pressure, by (17) with the gradient of `kernel`,
/// density by poly6 (20).
double settledDistance(const KernelCube& cube, sph::KernelType type, std::uint64_t seed) {
  const sph::SmoothingKernel kernel{type, cube.support, 0.0};
  sph::JitterSource jitter{seed};
  Cloud cloud = jitteredCube(cube, jitter);
  Cloud velocity(cloud.size(), Vec3::Zero());
  const sph::SmoothingKernel poly6{sph::KernelType::poly6, cube.support, 0.0};
  for (int step = 0; step < cube.steps; ++step) {
    std::vector<double> density(cloud.size(), poly6.value(0.0));
    forPairs(cloud, cube.side, cube.support, [&](std::size_t i, std::size_t j, const Vec3&, double r) {
      density[i] += poly6.value(r);
      density[j] += poly6.value(r);
    });
    Cloud acceleration(cloud.size(), Vec3::Zero());
    forPairs(cloud, cube.side, cube.support, [&](std::size_t i, std::size_t j, const Vec3& apart, double r) {
      const double pressures = density[i] + density[j] - 2.0 * kRest;
      const Vec3 a = -pressures / (2.0 * density[i] * density[j]) * kernel.slope(r) / std::max(r, 1e-6) * apart;
      acceleration[i] += a;
      acceleration[j] -= a;
    });
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      velocity[i] = kKept * (velocity[i] + cube.dt * acceleration[i]);
      cloud[i] += cube.dt * velocity[i];
    }
  }
  std::vector<double> nearest(cloud.size(), cube.support);
  forPairs(cloud, cube.side, cube.support, [&](std::size_t i, std::size_t j, const Vec3&, double r) {
    nearest[i] = std::min(nearest[i], r);
    nearest[j] = std::min(nearest[j], r);
  });
  std::sort(nearest.begin(), nearest.end());
  return nearest[static_cast<std::size_t>(kPercentile * static_cast<double>(nearest.size()))];
}

/// (sum v_i a_i)/(sum v_i^2) of random velocities, a_i = sum_j (v_j - v_i) lap W: above 0 the particles gain speed. In units of
/// what the viscosity kernel (33) takes away on the same particles.
double viscousGrowth(const KernelCube& cube, sph::KernelType type, std::uint64_t seed) {
  const sph::SmoothingKernel kernel{type, cube.support, 0.0};
  sph::JitterSource jitter{seed};
  const Cloud cloud = jitteredCube(cube, jitter);
  Cloud velocity(cloud.size());
  for (Vec3& v : velocity) v = {jitter.next(), jitter.next(), jitter.next()};
  const sph::SmoothingKernel viscosity{sph::KernelType::viscosity, cube.support, 0.0};
  double power = 0.0;
  double loss = 0.0;
  forPairs(cloud, cube.side, cube.support, [&](std::size_t i, std::size_t j, const Vec3&, double r) {
    const double relative2 = (velocity[i] - velocity[j]).squaredNorm();
    power -= kernel.laplacian(r) * relative2;
    loss += viscosity.laplacian(r) * relative2;
  });
  return power / loss;
}

double leastLaplacian(sph::KernelType type) {
  const sph::SmoothingKernel kernel{type, 1.0, 0.0};
  double least = kernel.laplacian(1.0);
  for (int k = 100; k < 1000; ++k) least = std::min(least, kernel.laplacian(1e-3 * k));
  return least;
}

/// Up to which q the Laplacian is negative.
double negativeUpTo(sph::KernelType type) {
  const sph::SmoothingKernel kernel{type, 1.0, 0.0};
  double last = 0.0;
  for (int k = 1; k < 1000; ++k) {
    if (kernel.laplacian(1e-3 * k) < 0.0) last = 1e-3 * k;
  }
  return last;
}

/// Of one figure over the seeds.
template <class Figure>
Measured overSeeds(const KernelCube& cube, const Figure& figure) {
  std::vector<double> values;
  for (std::uint64_t k = 0; k < kKernelSeeds; ++k) values.push_back(figure(cube.seed + k));
  return meanOf(values);
}

}  // namespace

Result<KernelCube> kernelCubeOf(const scene::SceneDescription& scene) {
  const sph::WorldDescription& world = scene.world;
  const auto seconds = horizonOf(scene);
  if (!seconds) return seconds.status();
  const bool periodic = world.domain.periodic[0] && world.domain.periodic[1] && world.domain.periodic[2];
  const bool one = world.fluid_blocks.size() == 1;
  const auto counts = one ? sph::blockLattice(world.fluid_blocks.front(), world.spacing) : std::array<std::uint64_t, 3>{0, 1, 2};
  if (!periodic || counts[0] != counts[1] || counts[1] != counts[2] || !std::isfinite(world.max_dt)) {
    return Status{StatusCode::invalid_argument,
                  "scene '" + scene.name + "' needs one cubic fluid block, periodic sides on all axes and max_dt_s"};
  }
  const double time = world.spacing / sph::speedOfSound(world);
  return KernelCube{.side = static_cast<int>(counts[0]),
                    .support = world.support_ratio,
                    .jitter = world.fluid_blocks.front().jitter,
                    .dt = world.max_dt / time,
                    .steps = static_cast<int>(std::lround(*seconds / world.max_dt)),
                    .seed = world.seed};
}

Claim clusterClaim(const KernelCube& cube) {
  const Measured spiky = overSeeds(cube, [&](std::uint64_t seed) { return settledDistance(cube, sph::KernelType::spiky, seed); });
  const Measured poly6 = overSeeds(cube, [&](std::uint64_t seed) { return settledDistance(cube, sph::KernelType::poly6, seed); });
  Claim claim{.sentence = "poly6 for pressure clusters particles",
              .figure = "first percentile of nearest distances, spacings",
              .with = "spiky",
              .without = "poly6",
              .claimed = Direction::smaller,
              .evidence = {compare("cube", spiky, poly6, Direction::smaller)},
              .verdict = Verdict::depends};
  claim.evidence.front().note = fmt::format(
      "{0} x {0} x {0} periodic, {1:g} of the lattice's density at rest, jitter {2:g} dx, h = {3:g} dx, {4} steps of "
      "{5:.2g} dx/c0 that keep {6:g} of the velocity, {7} seeds",
      cube.side, kRest, cube.jitter, cube.support, cube.steps, cube.dt, kKept, kKernelSeeds);
  conclude(claim);
  return claim;
}

Claim laplacianClaim() {
  Claim claim{.sentence = "the Laplacians of poly6 and spiky are negative in a range",
              .figure = "least Laplacian in 0.1 h < r < h, 1/h^5",
              .with = "viscosity kernel",
              .without = "this kernel",
              .claimed = Direction::smaller,
              .evidence = {},
              .verdict = Verdict::depends};
  const Measured reference{leastLaplacian(sph::KernelType::viscosity), 0.0};
  for (const auto& [name, type] : {std::pair{"poly6", sph::KernelType::poly6}, std::pair{"spiky", sph::KernelType::spiky}}) {
    Evidence evidence = compare(name, reference, Measured{leastLaplacian(type), 0.0}, Direction::smaller);
    evidence.note = "negative up to r = " + std::to_string(negativeUpTo(type)) + " h";
    claim.evidence.push_back(std::move(evidence));
  }
  conclude(claim);
  return claim;
}

Claim viscousGrowthClaim(const KernelCube& cube) {
  Claim claim{.sentence = "viscosity from the Laplacians of poly6 or spiky speeds particles up",
              .figure = "growth of kinetic energy, the viscosity kernel's loss being 1",
              .with = "none",
              .without = "this kernel",
              .claimed = Direction::larger,
              .evidence = {},
              .verdict = Verdict::depends};
  const auto add = [&](const std::string& name, sph::KernelType type) {
    const double pair = -sph::SmoothingKernel{type, 1.0, 0.0}.laplacian(kNear) /
                        sph::SmoothingKernel{sph::KernelType::viscosity, 1.0, 0.0}.laplacian(kNear);
    claim.evidence.push_back(compare(name + " pair", Measured{0.0, 0.0}, Measured{pair, 0.0}, Direction::larger));
    claim.evidence.back().note = fmt::format("two particles {:g} h apart", kNear);
    const Measured growth = overSeeds(cube, [&](std::uint64_t seed) { return viscousGrowth(cube, type, seed); });
    claim.evidence.push_back(compare(name + " body", Measured{0.0, 0.0}, growth, Direction::larger));
    claim.evidence.back().note = fmt::format("random velocities in bulk, h = {:g} dx, {} seeds", cube.support, kKernelSeeds);
  };
  add("poly6", sph::KernelType::poly6);
  add("spiky", sph::KernelType::spiky);
  conclude(claim);
  return claim;
}

}  // namespace bleedsim::lab
