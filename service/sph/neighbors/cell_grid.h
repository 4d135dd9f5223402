// A uniform grid of cells as wide as the search reaches, rebuilt every step by a stable counting sort of the particles.
//
// The grid covers the particles only, so far empty space costs nothing. Cells are anchored at the coordinate origin (at the
// domain's corner along a periodic axis): the order of the particles does not depend on where the bounding box happens to be.
// Along periodic axes cells are as wide as the search may ever reach.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/grid_view.h"
#include "service/sph/quad.h"
#include "service/sph/share_range.h"

namespace bleedsim::sph {

/// Bounds of positions, in support radii.
template <class Real>
struct Bounds {
  std::array<Real, 3> lower{Real(1e9), Real(1e9), Real(1e9)};
  std::array<Real, 3> upper{Real(-1e9), Real(-1e9), Real(-1e9)};

  void merge(const Bounds& other) {
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], other.lower[a]);
      upper[a] = std::max(upper[a], other.upper[a]);
    }
  }
  void include(Real x, Real y, Real z) {
    lower = {std::min(lower[0], x), std::min(lower[1], y), std::min(lower[2], z)};
    upper = {std::max(upper[0], x), std::max(upper[1], y), std::max(upper[2], z)};
  }
};

template <class Real>
class CellGrid {
 public:
  static constexpr std::uint32_t kRemoved = 0xffffffffu;  ///< cell of a particle that the sort drops

  CellGrid() = default;
  /// `lower`, `upper`: the domain in support radii; particles may also stand up to `margin` outside of it (wounds' throats).
  /// `largest_cell` is the largest that cover() will be given.
  CellGrid(std::uint32_t capacity, const std::array<double, 3>& lower, const std::array<double, 3>& upper,
           const std::array<bool, 3>& periodic, double margin, int shares, double largest_cell = 1.0)
      : cell_of_{capacity, 23} {
    view_.periodic = periodic;
    std::size_t most = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const double length = upper[a] - lower[a];
      if (periodic[a]) {
        const int cells = std::max(3, static_cast<int>(length / largest_cell));
        corner_[a] = static_cast<Real>(lower[a]);
        scale_[a] = static_cast<Real>(cells / length);
        width_[a] = static_cast<Real>(length / cells);
        slack_[a] = roundingOf(Real(0), cells, width_[a]) + roundingOf(corner_[a], 0, Real(1));
        view_.period[a] = static_cast<Real>(length);
        setSize(a, cells + 2);
        most *= static_cast<std::size_t>(cells) + 2;
      } else {
        scale_[a] = Real(1);
        lowest_[a] = static_cast<Real>(lower[a] - margin);
        highest_[a] = static_cast<Real>(upper[a] + margin);
        most *= static_cast<std::size_t>(std::ceil(length + 2.0 * margin)) + 4;
      }
    }
    start_ = AlignedArray<std::uint32_t>{most + 2, 29};
    histograms_.resize(static_cast<std::size_t>(shares));
    block_totals_.resize(static_cast<std::size_t>(shares) * static_cast<std::size_t>(shares));
    for (auto& histogram : histograms_) histogram = AlignedArray<std::uint32_t>{most + 2, 31};
    view_.start = start_.data();
  }

  /// From now on all particles stand in one cell, whatever its size. Not with periodic sides.
  void useOneCell() { one_cell_ = true; }

  const GridView<Real>& view() const { return view_; }
  std::size_t bytes() const {
    std::size_t sum = start_.bytes() + cell_of_.bytes();
    for (const AlignedArray<std::uint32_t>& histogram : histograms_) sum += histogram.bytes();
    return sum;
  }
  std::uint32_t* cells() { return cell_of_.data(); }

  /// Narrows bounds, in support radii, to where the particles of a cell stand along an axis, given its 1-based coordinate there.
  /// Along a periodic axis they must stand between the sides.
  void narrow(std::size_t axis, int coordinate, Bounds<Real>& bounds) const {
    const Real from = corner_[axis] + (origin_[axis] + static_cast<Real>(coordinate - 1)) * width_[axis];
    const bool outer = !view_.periodic[axis];  // the outermost cells hold all that is beyond them
    bounds.lower[axis] = outer && coordinate == 1 ? covered_.lower[axis] : from - slack_[axis];
    bounds.upper[axis] = outer && coordinate == view_.size[axis] - 2 ? covered_.upper[axis] : from + width_[axis] + slack_[axis];
  }

  /// Lays the grid over the bounds, with cells of at least `cell` >= 1 support radii. Particles beyond the margin fall into the
  /// outermost cells: right, though slow, for the few unseen ones of a deep throat.
  void cover(const Bounds<Real>& bounds, Real cell = Real(1)) {
    covered_ = bounds;
    for (std::size_t a = 0; a < 3; ++a) {
      if (view_.periodic[a]) continue;
      width_[a] = cell;
      scale_[a] = Real(1) / cell;
      if (one_cell_ || bounds.lower[a] > bounds.upper[a]) {
        origin_[a] = Real(0);
        setSize(a, 3);
        continue;
      }
      origin_[a] = std::floor(std::max(bounds.lower[a], lowest_[a]) * scale_[a]);
      setSize(a, std::max(0, static_cast<int>(std::min(bounds.upper[a], highest_[a]) * scale_[a] - origin_[a])) + 3);
      slack_[a] = roundingOf(origin_[a], view_.size[a], cell);
    }
  }

  std::uint32_t cellAt(Real x, Real y, Real z) const {
    const int cx = coordinate(0, x);
    const int cy = coordinate(1, y);
    const int cz = coordinate(2, z);
    return static_cast<std::uint32_t>((cz * view_.size[1] + cy) * view_.size[0] + cx);
  }
  /// 1-based cell coordinate along an axis, clamped to the grid.
  int coordinate(std::size_t axis, Real value) const {
    // In this order a value that is no number gives the first cell.
    const Real c = std::max(Real(0), (value - corner_[axis]) * scale_[axis] - origin_[axis]);
    return static_cast<int>(std::min(c, last_[axis])) + 1;
  }

  /// Counts cells() of n particles, then calls move(from, to, length) for runs of particles that stay and keep together: `to` is
  /// the place of the first in cell order, equal cells in the old order. Returns how many stay. The order is the same for any
  /// number of shares, the runs are not.
  template <class Move>
  std::uint32_t sortRuns(std::uint32_t n, int shares, Executor& executor, Move&& move) {
    const auto cells = static_cast<std::uint32_t>(view_.size[0] * view_.size[1] * view_.size[2]);
    executor.run(shares, [&](int share) {
      std::uint32_t* histogram = histograms_[static_cast<std::size_t>(share)].data();
      std::fill_n(histogram, cells, 0u);
      const ShareRange range{n, share, shares};
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (cell_of_[i] != kRemoved) ++histogram[cell_of_[i]];
      }
      if (shares < kSharesToScanApart) return;
      for (int block = 0; block < shares; ++block) {
        const ShareRange own{cells, block, shares};
        blockTotal(share, block, shares) = std::accumulate(histogram + own.begin, histogram + own.end, 0u);
      }
    });
    std::uint32_t sum = 0;
    if (shares < kSharesToScanApart) {
      sum = scanCells({cells, 0, 1}, shares, 0);
    } else {
      executor.run(shares, [&](int block) {
        std::uint32_t before = 0;
        for (int k = 0; k < block; ++k) {
          for (int share = 0; share < shares; ++share) before += blockTotal(share, k, shares);
        }
        scanCells({cells, block, shares}, shares, before);
      });
      sum = std::accumulate(block_totals_.begin(), block_totals_.begin() + shares * shares, 0u);
    }
    start_[cells] = sum;
    executor.run(shares, [&](int share) {
      std::uint32_t* next = histograms_[static_cast<std::size_t>(share)].data();
      const ShareRange range{n, share, shares};
      std::uint32_t from = range.begin;
      std::uint32_t to = 0;
      std::uint32_t length = 0;
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const bool stays = cell_of_[i] != kRemoved;
        const std::uint32_t place = stays ? next[cell_of_[i]]++ : 0;
        if (stays && length != 0 && length < kLongestRun && place == to + length) {
          ++length;
          continue;
        }
        if (length != 0) move(from, to, length);
        from = i;
        to = place;
        length = stays ? 1 : 0;
      }
      if (length != 0) move(from, to, length);
    });
    return sum;
  }

  /// The same, with move(from, to) for every particle.
  template <class Move>
  std::uint32_t sort(std::uint32_t n, int shares, Executor& executor, Move&& move) {
    return sortRuns(n, shares, executor, [&move](std::uint32_t from, std::uint32_t to, std::uint32_t length) {
      for (std::uint32_t k = 0; k < length; ++k) move(from + k, to + k);
    });
  }

  /// First row of a share: rows are split where the particles are, so that shares hold about equally many.
  int firstRow(int share, int shares, std::uint32_t n) const {
    if (share == shares) return view_.rows();
    const auto wanted =
        static_cast<std::uint32_t>(std::uint64_t{n} * static_cast<std::uint64_t>(share) / static_cast<std::uint64_t>(shares));
    int low = 0;
    int high = view_.rows();
    while (low < high) {
      const int middle = (low + high) / 2;
      if (view_.rowBegin(middle) < wanted)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

 private:
  static constexpr std::uint32_t kLongestRun = 64;  // what one call moves stays in the first-level cache

  /// From here on each share makes places of a block of cells: alone, one thread would take longer the more there are.
  static constexpr int kSharesToScanApart = 3;

  /// Particles of a share that stand in a block of cells.
  std::uint32_t& blockTotal(int share, int block, int shares) {
    return block_totals_[static_cast<std::size_t>(share * shares + block)];
  }

  /// Makes places of the counts of a block of cells, with `sum` particles before them. Returns how many stand before its end.
  std::uint32_t scanCells(ShareRange block, int shares, std::uint32_t sum) {
    for (std::uint32_t c = block.begin; c < block.end; ++c) {
      if (c + 4 <= block.end && fourEmpty(c, shares)) {  // most cells are empty, and nobody asks for their places
        std::fill_n(start_.data() + c, 4, sum);
        c += 3;
        continue;
      }
      start_[c] = sum;
      for (int share = 0; share < shares; ++share) {
        std::uint32_t& entry = histograms_[static_cast<std::size_t>(share)][c];
        const std::uint32_t count = entry;
        entry = sum;
        sum += count;
      }
    }
    return sum;
  }

  bool fourEmpty(std::size_t cell, int shares) const {
    bool empty = true;
    for (int share = 0; share < shares; ++share) {
      empty = empty && fourZeros(histograms_[static_cast<std::size_t>(share)].data() + cell);
    }
    return empty;
  }

  void setSize(std::size_t axis, int size) {
    view_.size[axis] = size;
    last_[axis] = static_cast<Real>(size - 3);
  }

  /// How far off the place of a cell may be that stands `cells` from `origin`, in support radii.
  static Real roundingOf(Real origin, int cells, Real width) {
    return Real(8) * std::numeric_limits<Real>::epsilon() * (std::abs(origin) + static_cast<Real>(cells)) * width;
  }

  GridView<Real> view_;
  Bounds<Real> covered_;
  std::array<Real, 3> corner_{};  ///< what cells are counted from: the domain's corner where periodic, else the origin
  std::array<Real, 3> origin_{};  ///< the first cell of the bounds, counted from there
  std::array<Real, 3> scale_{Real(1), Real(1), Real(1)};  ///< cells per support radius, <= 1
  std::array<Real, 3> width_{Real(1), Real(1), Real(1)};  ///< of a cell, in support radii
  std::array<Real, 3> slack_{};                           ///< rounding of a cell's place, in support radii
  std::array<Real, 3> last_{};                            ///< the outermost cell, counted from the first
  std::array<Real, 3> lowest_{}, highest_{};              ///< what the grid covers at most, in support radii
  bool one_cell_ = false;
  AlignedArray<std::uint32_t> start_;
  AlignedArray<std::uint32_t> cell_of_;
  std::vector<AlignedArray<std::uint32_t>> histograms_;
  std::vector<std::uint32_t> block_totals_;  ///< of each share, the blocks of cells
};

}  // namespace bleedsim::sph
