// Two particles on one spot have no direction to be pushed apart in, so they would stay one for ever. They are set apart by a
// thousandth of a spacing each; from there on pressure or repulsion acts.
//
// The direction follows from the two ids alone, and the two go opposite ways from where they stood: velocities, momentum and the
// centre of mass stay. Neither leaves the domain: across a periodic side it comes in again, at another one it stops. Particles
// that a wound drives stay where their wound has them. Not in the literal model: the paper has none.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/neighbors/domain_box.h"
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
  Coincidence(double spacing, bool planar, const DomainBox<Real>& domain, int shares)
      : shift_{static_cast<Real>(kShift * spacing)},
        planar_{planar},
        domain_{domain},
        parted_(static_cast<std::size_t>(shares)) {}

  /// For a grid of one cell, whose pairs are too many to look at: particles are sorted instead.
  void useOneCell(std::uint32_t capacity) { sorted_.resize(capacity); }

  /// Parts the particles, which stand as `grid` has sorted them; returns how many were moved. It looks at every pair of a cell.
  std::uint64_t part(const CellGrid<Real>& grid, Particles<Real>& p, std::uint32_t count, int shares, Executor& executor) {
    if (!sorted_.empty()) return partSorted(p, count);
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

  std::size_t bytes() const { return sorted_.size() * sizeof(Place); }

 private:
  static constexpr double kShift = 1e-3;     // of a particle, in spacings
  static constexpr Real kSpot = Real(1e-6);  // in support radii: closer than this, pair forces lose their direction
  // Particles are sorted along this unit vector, which is askew to every lattice. Those on one spot differ by at most sqrt(3)
  // kSpot.
  static constexpr std::array<double, 3> kAskew{0.5377, 0.7071, 0.4593};
  static constexpr double kWindow = 2.0 * static_cast<double>(kSpot);
  static constexpr std::uint32_t kMoved = 0xffffffffu;  // instead of its particle

  struct alignas(64) Count {
    std::uint64_t particles = 0;
  };
  struct Place {
    double along;  // kAskew, in support radii
    std::uint32_t particle;
    bool operator<(const Place& other) const { return along != other.along ? along < other.along : particle < other.particle; }
  };

  static bool onOneSpot(const Particles<Real>& p, std::uint32_t i, std::uint32_t j) {
    return std::abs(p.x[i] - p.x[j]) < kSpot && std::abs(p.y[i] - p.y[j]) < kSpot && std::abs(p.z[i] - p.z[j]) < kSpot;
  }

  std::uint64_t partWithin(Particles<Real>& p, std::uint32_t begin, std::uint32_t end) const {
    std::uint64_t parted = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      for (std::uint32_t j = i + 1; j < end; ++j) {
        if (onOneSpot(p, i, j)) parted += partPair(p, i, j);
      }
    }
    return parted;
  }

  std::uint64_t partSorted(Particles<Real>& p, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = static_cast<double>(p.x[i]);
      const double y = static_cast<double>(p.y[i]);
      const double z = static_cast<double>(p.z[i]);
      sorted_[i] = {kAskew[0] * x + kAskew[1] * y + kAskew[2] * z, i};
    }
    const auto end = sorted_.begin() + count;
    std::sort(sorted_.begin(), end);
    std::uint64_t parted = 0;
    for (auto first = sorted_.begin(); first != end; ++first) {
      for (auto next = first + 1; next != end && next->along - first->along < kWindow && first->particle != kMoved; ++next) {
        if (next->particle == kMoved || !onOneSpot(p, first->particle, next->particle)) continue;
        parted += partPair(p, first->particle, next->particle);
        for (Place* place : {&*first, &*next}) {
          if (p.driver[place->particle] == 0) place->particle = kMoved;
        }
      }
    }
    return parted;
  }

  /// Returns how many of the two are free to move.
  std::uint64_t partPair(Particles<Real>& p, std::uint32_t i, std::uint32_t j) const {
    const std::array<Real, 3> direction = partingDirection<Real>(p.id[i], p.id[j], planar_);
    const bool both = p.driver[i] == 0 && p.driver[j] == 0;
    return shift(p, i, shift_, direction, both) + shift(p, j, -shift_, direction, both);
  }
  /// A particle that parts from one that stays turns back at a side where one of two free ones would stop.
  std::uint64_t shift(Particles<Real>& p, std::uint32_t i, Real length, const std::array<Real, 3>& direction, bool both) const {
    if (p.driver[i] != 0) return 0;
    p.x[i] = shifted(0, p.x[i], length * direction[0], both);
    p.y[i] = shifted(1, p.y[i], length * direction[1], both);
    p.z[i] = shifted(2, p.z[i], length * direction[2], both);
    return 1;
  }
  Real shifted(std::size_t axis, Real from, Real by, bool both) const {
    const Real to = from + by;
    if (domain_.periodic[axis]) return domain_.wrapped(axis, to);
    // A particle that a throat has just released may stand outside.
    const Real lowest = std::min(from, domain_.lower[axis]);
    const Real highest = std::max(from, domain_.upper[axis]);
    if (!both && (to < lowest || to > highest)) return from - by;
    return std::clamp(to, lowest, highest);
  }

  Real shift_;  // in support radii
  bool planar_;
  DomainBox<Real> domain_;
  std::vector<Count> parted_;
  std::vector<Place> sorted_;  // empty: pairs are looked for in cells
};

}  // namespace bleedsim::sph
