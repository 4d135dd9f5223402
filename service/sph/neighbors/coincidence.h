// Two particles on one spot have no direction to be pushed apart in, so they would stay one for ever. They are set apart by a
// thousandth of a spacing each; from there on pressure or repulsion acts.
//
// The direction follows from the two ids alone, and the two go opposite ways from where they stood: velocities, momentum and the
// centre of mass stay. Particles that a wound drives stay where their wound has them. Not in the literal model: the paper has
// none.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"

namespace bleedsim::sph {

/// A unit vector from a pair of ids, exactly opposite for (b, a); a != b. `planar`: none along z.
template <class Real>
std::array<Real, 3> partingDirection(std::uint32_t a, std::uint32_t b, bool planar) {
  // The finalizer of SplitMix64 (Steele, Lea & Flood 2014); three fields of 21 bits are the components.
  std::uint64_t bits = (std::uint64_t{std::min(a, b)} << 32 | std::max(a, b)) + 0x9e3779b97f4a7c15ull;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ull;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebull;
  bits ^= bits >> 31;
  std::array<double, 3> v{};
  for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<double>(bits >> (21 * k) & 0x1fffff) / 0x100000 - 1.0;
  if (planar) v[2] = 0.0;
  double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  if (!(length > 0.01)) {
    v = {1.0, 0.0, 0.0};
    length = 1.0;
  }
  const double sign = a < b ? 1.0 : -1.0;
  return {static_cast<Real>(sign * v[0] / length), static_cast<Real>(sign * v[1] / length),
          static_cast<Real>(sign * v[2] / length)};
}

template <class Real>
class Coincidence {
 public:
  /// `spacing` in support radii.
  Coincidence(double spacing, bool planar, int shares)
      : shift_{static_cast<Real>(kShift * spacing)}, planar_{planar}, parted_(static_cast<std::size_t>(shares)) {}

  /// Parts the particles, which stand as `grid` has sorted them; returns how many were moved. It looks at every pair of a cell.
  std::uint64_t part(const CellGrid<Real>& grid, Particles<Real>& p, std::uint32_t count, int shares, Executor& executor) {
    executor.run(shares, [&](int share) {
      const GridView<Real>& view = grid.view();
      const int end = grid.firstRow(share + 1, shares, count);
      std::uint64_t& parted = parted_[static_cast<std::size_t>(share)].particles;
      parted = 0;
      for (int row = grid.firstRow(share, shares, count); row < end; ++row) {
        for (int x = 0; x < view.size[0]; ++x) {
          const std::size_t cell = view.cell(row, x);
          parted += partWithin(p, view.start[cell], view.start[cell + 1]);
        }
      }
    });
    std::uint64_t sum = 0;
    for (int share = 0; share < shares; ++share) sum += parted_[static_cast<std::size_t>(share)].particles;
    return sum;
  }

 private:
  static constexpr double kShift = 1e-3;     // of a particle, in spacings
  static constexpr Real kSpot = Real(1e-6);  // in support radii: closer than this, pair forces lose their direction

  struct alignas(64) Count {
    std::uint64_t particles = 0;
  };

  std::uint64_t partWithin(Particles<Real>& p, std::uint32_t begin, std::uint32_t end) const {
    std::uint64_t parted = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      for (std::uint32_t j = i + 1; j < end; ++j) {
        if (std::abs(p.x[i] - p.x[j]) < kSpot && std::abs(p.y[i] - p.y[j]) < kSpot && std::abs(p.z[i] - p.z[j]) < kSpot) {
          parted += partPair(p, i, j);
        }
      }
    }
    return parted;
  }

  /// Returns how many of the two are free to move.
  std::uint64_t partPair(Particles<Real>& p, std::uint32_t i, std::uint32_t j) const {
    const std::array<Real, 3> direction = partingDirection<Real>(p.id[i], p.id[j], planar_);
    return shift(p, i, shift_, direction) + shift(p, j, -shift_, direction);
  }
  static std::uint64_t shift(Particles<Real>& p, std::uint32_t i, Real length, const std::array<Real, 3>& direction) {
    if (p.driver[i] != 0) return 0;
    p.x[i] += length * direction[0];
    p.y[i] += length * direction[1];
    p.z[i] += length * direction[2];
    return 1;
  }

  Real shift_;  // in support radii
  bool planar_;
  std::vector<Count> parted_;
};

}  // namespace bleedsim::sph
