// What the paper says of its kernels, on small bodies of particles summed pair by pair. Lengths in spacings, masses in rho0 dx^3,
// the speed of sound is 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "service/lab/paper/claims.h"
#include "service/sph/seeding.h"

namespace bleedsim::lab {
namespace {

constexpr int kSide = 6;  // particles along a periodic cube
constexpr std::size_t kCount = kSide * kSide * kSide;
constexpr double kSupport = 2.0;
constexpr double kJitter = 0.2;
constexpr int kSeeds = 5;

using Vec3 = sph::Vec3;
using Cloud = std::array<Vec3, kCount>;

Cloud jitteredCube(sph::JitterSource& jitter) {
  Cloud cloud;
  std::size_t at = 0;
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) {
      for (int z = 0; z < kSide; ++z) {
        Vec3& position = cloud[at++];
        position = Vec3{double(x), double(y), double(z)};
        for (Eigen::Index a = 0; a < 3; ++a) position[a] += kJitter * jitter.next();
      }
    }
  }
  return cloud;
}

/// Calls pair(i, j, x_i - x_j, r) for every pair nearer than `reach`, across the sides too.
template <class Consume>
void forPairs(const Cloud& cloud, double reach, Consume&& pair) {
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t j = i + 1; j < kCount; ++j) {
      Vec3 apart = cloud[i] - cloud[j];
      for (Eigen::Index a = 0; a < 3; ++a) apart[a] -= kSide * std::round(apart[a] / kSide);
      const double r = apart.norm();
      if (r < reach) pair(i, j, apart, r);
    }
  }
}

/// Mean of the values with their standard error.
Measured meanOf(const std::array<double, kSeeds>& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / kSeeds;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (kSeeds * (kSeeds - 1)))};
}

/// First percentile of the nearest distances after a damped fall into rest under pressure, by (17) with the gradient of `kernel`,
/// density by poly6 (20). The cube is a quarter denser than rest, so that pressure acts everywhere.
double settledDistance(const sph::SmoothingKernel& kernel, std::uint64_t seed) {
  constexpr double kRest = 0.8;
  constexpr double kDt = 0.1;
  constexpr double kKept = 0.95;  // of the velocity, a step
  constexpr int kSteps = 400;
  sph::JitterSource jitter{seed};
  Cloud cloud = jitteredCube(jitter);
  Cloud velocity;
  velocity.fill(Vec3::Zero());
  const sph::SmoothingKernel poly6{sph::KernelType::poly6, kSupport, 0.0};
  for (int step = 0; step < kSteps; ++step) {
    std::array<double, kCount> density;
    density.fill(poly6.value(0.0));
    forPairs(cloud, kSupport, [&](std::size_t i, std::size_t j, const Vec3&, double r) {
      density[i] += poly6.value(r);
      density[j] += poly6.value(r);
    });
    Cloud acceleration;
    acceleration.fill(Vec3::Zero());
    forPairs(cloud, kSupport, [&](std::size_t i, std::size_t j, const Vec3& apart, double r) {
      const double pressures = density[i] + density[j] - 2.0 * kRest;
      const Vec3 a = -pressures / (2.0 * density[i] * density[j]) * kernel.slope(r) / std::max(r, 1e-6) * apart;
      acceleration[i] += a;
      acceleration[j] -= a;
    });
    for (std::size_t i = 0; i < kCount; ++i) {
      velocity[i] = kKept * (velocity[i] + kDt * acceleration[i]);
      cloud[i] += kDt * velocity[i];
    }
  }
  std::array<double, kCount> nearest;
  nearest.fill(kSupport);
  forPairs(cloud, kSupport, [&](std::size_t i, std::size_t j, const Vec3&, double r) {
    nearest[i] = std::min(nearest[i], r);
    nearest[j] = std::min(nearest[j], r);
  });
  std::sort(nearest.begin(), nearest.end());
  return nearest[kCount / 100];
}

/// (sum v_i a_i)/(sum v_i^2) of random velocities, a_i = sum_j (v_j - v_i) lap W: above 0 the particles gain speed. In units of
/// what the viscosity kernel (33) takes away on the same particles.
double viscousGrowth(const sph::SmoothingKernel& kernel, std::uint64_t seed) {
  sph::JitterSource jitter{seed};
  const Cloud cloud = jitteredCube(jitter);
  Cloud velocity;
  for (Vec3& v : velocity) v = {jitter.next(), jitter.next(), jitter.next()};
  const sph::SmoothingKernel viscosity{sph::KernelType::viscosity, kSupport, 0.0};
  double power = 0.0;
  double loss = 0.0;
  forPairs(cloud, kSupport, [&](std::size_t i, std::size_t j, const Vec3&, double r) {
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

}  // namespace

Claim clusterClaim() {
  std::array<double, kSeeds> spiky{};
  std::array<double, kSeeds> poly6{};
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto at = static_cast<std::size_t>(seed);
    spiky[at] = settledDistance({sph::KernelType::spiky, kSupport, 0.0}, at + 1);
    poly6[at] = settledDistance({sph::KernelType::poly6, kSupport, 0.0}, at + 1);
  }
  Claim claim{.sentence = "poly6 for pressure clusters particles",
              .figure = "first percentile of nearest distances, spacings",
              .with = "spiky",
              .without = "poly6",
              .claimed = Direction::smaller,
              .evidence = {compare("cube", meanOf(spiky), meanOf(poly6), Direction::smaller)},
              .verdict = Verdict::depends};
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

Claim viscousGrowthClaim() {
  Claim claim{.sentence = "viscosity from the Laplacians of poly6 or spiky speeds particles up",
              .figure = "growth of kinetic energy, the viscosity kernel's loss being 1",
              .with = "none",
              .without = "this kernel",
              .claimed = Direction::larger,
              .evidence = {},
              .verdict = Verdict::depends};
  constexpr double kNear = 0.4;  // support radii
  const auto add = [&](const std::string& name, sph::KernelType type) {
    const double pair = -sph::SmoothingKernel{type, 1.0, 0.0}.laplacian(kNear) /
                        sph::SmoothingKernel{sph::KernelType::viscosity, 1.0, 0.0}.laplacian(kNear);
    claim.evidence.push_back(compare(name + " pair", Measured{0.0, 0.0}, Measured{pair, 0.0}, Direction::larger));
    claim.evidence.back().note = "two particles 0.4 h apart";
    std::array<double, kSeeds> growth{};
    for (std::size_t seed = 0; seed < growth.size(); ++seed) growth[seed] = viscousGrowth({type, kSupport, 0.0}, seed + 1);
    claim.evidence.push_back(compare(name + " body", Measured{0.0, 0.0}, meanOf(growth), Direction::larger));
    claim.evidence.back().note = "random velocities in bulk, h = 2 dx";
  };
  add("poly6", sph::KernelType::poly6);
  add("spiky", sph::KernelType::spiky);
  conclude(claim);
  return claim;
}

}  // namespace bleedsim::lab
