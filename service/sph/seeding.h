// Places the particles of fluid blocks.
#pragma once

#include <cmath>
#include <cstdint>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// How many particles stand along each axis of a block: the whole spacings that fit.
inline std::array<std::uint64_t, 3> blockLattice(const FluidBlock& block, double spacing) {
  std::array<std::uint64_t, 3> counts{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double fit = std::floor((block.upper[axis] - block.lower[axis]) / spacing + 1e-6);
    counts[a] = fit > 0.0 ? static_cast<std::uint64_t>(std::min(fit, 1e7)) : 0;
  }
  return counts;
}

/// splitmix64 (Steele, Lea & Flood 2014): jitter must be the same on every machine.
class JitterSource {
 public:
  explicit JitterSource(std::uint64_t seed) : state_{seed} {}
  /// Uniform in [-1, 1).
  double next() {
    state_ += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
  }

 private:
  std::uint64_t state_;
};

/// Calls place(position in m) for every particle of the block, x fastest; the first rows stand half a spacing inside the faces,
/// no extra gap (walls.md, Seeding).
template <class Place>
void seedBlock(const FluidBlock& block, double spacing, JitterSource& jitter, Place&& place) {
  const auto counts = blockLattice(block, spacing);
  for (std::uint64_t k = 0; k < counts[2]; ++k) {
    for (std::uint64_t j = 0; j < counts[1]; ++j) {
      for (std::uint64_t i = 0; i < counts[0]; ++i) {
        Vec3 position = block.lower + spacing * (Vec3{double(i), double(j), double(k)} + Vec3::Constant(0.5));
        if (block.jitter > 0.0) {
          for (Eigen::Index a = 0; a < 3; ++a) position[a] += block.jitter * spacing * jitter.next();
        }
        place(position);
      }
    }
  }
}

}  // namespace bleedsim::sph
