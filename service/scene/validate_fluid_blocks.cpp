#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

// A side that is a whole number of spacings must not lose a row, nor neighbouring blocks overlap, to rounding. Spacings.
constexpr double kRounding = 1e-6;

struct Block {
  int index;
  std::array<double, 3> lower;  ///< m
  std::array<double, 3> upper;  ///< m
};

std::array<double, 3> arrayOf(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

void requireInsideDomain(const std::string& path, const Block& block, const Domain& domain, ProblemList& problems) {
  constexpr std::array<char, 3> kAxes{'x', 'y', 'z'};
  const std::array<double, 3> lower = arrayOf(domain.lower_m());
  const std::array<double, 3> upper = arrayOf(domain.upper_m());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(lower[axis] < upper[axis])) continue;
    const auto require = [&](const char* corner, double value) {
      if (value >= lower[axis] && value <= upper[axis]) return;
      problems.add(fmt::format("{}.{}.{}", path, corner, kAxes[axis]),
                   fmt::format("value {} is outside the domain, allowed {} to {} (m)", value, lower[axis], upper[axis]));
    };
    require("lower_m", block.lower[axis]);
    require("upper_m", block.upper[axis]);
  }
}

double particlesOf(const Block& block, double spacing) {
  double particles = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    particles *= std::floor((block.upper[axis] - block.lower[axis]) / spacing + kRounding);
  }
  return particles;
}

bool overlap(const Block& a, const Block& b, double tolerance) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::min(a.upper[axis], b.upper[axis]) - std::max(a.lower[axis], b.lower[axis]) <= tolerance) return false;
  }
  return true;
}

void validateValues(const std::string& path, const FluidBlock& block, bool viscosity_effect, ProblemList& problems) {
  const Vec3& v = block.velocity_m_per_s();
  problems.requireInRange(path + ".velocity_m_per_s", std::hypot(v.x(), v.y(), v.z()), kBlockSpeed);
  problems.requireInRange(path + ".jitter", block.jitter(), kJitter);
  if (block.has_platelet()) problems.requireInRange(path + ".platelet", block.platelet(), kPlatelet);
  if (!block.has_viscosity_pa_s()) return;
  problems.requireInRange(path + ".viscosity_pa_s", block.viscosity_pa_s(), kViscosity);
  if (!viscosity_effect) {
    problems.add(path + ".viscosity_pa_s", "needs the viscosity effect; add effects { viscosity {} } or drop the field");
  }
}

void requireApart(const std::vector<Block>& blocks, double tolerance, ProblemList& problems) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!overlap(blocks[i], blocks[j], tolerance)) continue;
      problems.add(
          fmt::format("fluid_blocks[{}]", blocks[i].index),
          fmt::format("overlaps fluid_blocks[{}]; overlapping blood would burst apart, so move or shrink one", blocks[j].index));
    }
  }
}

}  // namespace

void validateFluidBlocks(const Scene& scene, ProblemList& problems) {
  const double spacing = scene.resolution().spacing_m();
  const bool spacing_known = spacing >= kSpacing.lower && spacing <= kSpacing.upper;
  const int count = requireCount("fluid_blocks", scene.fluid_blocks_size(), kMaxFluidBlocks, problems);
  std::vector<Block> blocks;
  double particles = 0.0;
  for (int i = 0; i < count; ++i) {
    const FluidBlock& message = scene.fluid_blocks(i);
    const std::string path = fmt::format("fluid_blocks[{}]", i);
    validateValues(path, message, scene.effects().has_viscosity(), problems);
    if (!requireBox(path, message.has_lower_m(), message.lower_m(), message.has_upper_m(), message.upper_m(), problems)) continue;
    const Block block{i, arrayOf(message.lower_m()), arrayOf(message.upper_m())};
    requireInsideDomain(path, block, scene.domain(), problems);
    blocks.push_back(block);
    if (!spacing_known) continue;
    const double block_particles = particlesOf(block, spacing);
    if (block_particles < 1.0)
      problems.add(path, fmt::format("holds no particle: each side must measure at least {} m", spacing));
    particles += block_particles;
  }
  if (particles > scene.domain().capacity()) {
    problems.add("domain.capacity", fmt::format("value {} is less than the {} particles of fluid_blocks; raise it, shrink the "
                                                "blocks or raise resolution.spacing_m",
                                                scene.domain().capacity(), particles));
  }
  requireApart(blocks, kRounding * (spacing_known ? spacing : kSpacing.lower), problems);
}

}  // namespace bleedsim::scene
