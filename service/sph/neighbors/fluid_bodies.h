// Which particles hang together: bodies of fluid, found anew in every step.
//
// Particles of one cell belong together; two neighbouring cells do if a particle of one lies within a support radius of one of
// the other. So a body is what the pair sums connect, except that particles of one cell never part, which joins what stands less
// than a cell's diagonal apart. Cells instead of particles make it cheap enough for every step, 4 % of one with surface tension
// at h = 2 dx and at most 1 % at 3 dx: most cells turn out to be joined already before any distance is measured.
//
// A body is named by its first particle in storage order, a cell by its own first one. Links go from larger to smaller names, so
// the outcome depends neither on the order of linking nor on the number of shares.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"

namespace bleedsim::sph {

template <class Real>
class FluidBodies {
 public:
  FluidBodies() = default;
  explicit FluidBodies(std::uint32_t capacity) : parent_{capacity, 61}, cell_end_{capacity, 67} {}

  /// Finds the bodies of `count` sorted particles.
  void find(const CellGrid<Real>& grid, const Particles<Real>& p, std::uint32_t count, int shares, Executor& executor) {
    const GridView<Real>& view = grid.view();
    executor.run(shares, [&](int share) {
      const RowRange rows{grid.firstRow(share, shares, count), grid.firstRow(share + 1, shares, count)};
      forEachCell(view, rows, [&](int, int, std::uint32_t first, std::uint32_t end) {
        parent_[first] = first;
        cell_end_[first] = end;
      });
      forEachCell(view, rows, [&](int row, int x, std::uint32_t first, std::uint32_t) {
        linkCell(view, p, row, x, first, [&](int other) { return rows.holds(other); });
      });
    });
    for (int share = 0; shares > 1 && share < shares; ++share) {
      const RowRange rows{grid.firstRow(share, shares, count), grid.firstRow(share + 1, shares, count)};
      const bool wraps = view.periodic[1] || view.periodic[2];
      const RowRange border{rows.begin, wraps ? rows.end : std::min(rows.end, rows.begin + view.size[1] + 1)};
      forEachCell(view, border, [&](int row, int x, std::uint32_t first, std::uint32_t) {
        linkCell(view, p, row, x, first, [&](int other) { return !rows.holds(other); });
      });
    }
    for (std::uint32_t first = 0; first < count; first = cell_end_[first]) parent_[first] = parent_[parent_[first]];
  }

  /// One past the last particle of the cell whose first particle is `first`: cells follow each other from particle 0 on.
  std::uint32_t cellEnd(std::uint32_t first) const { return cell_end_[first]; }
  /// The body of that cell: its first particle, which is the first one of a cell, too.
  std::uint32_t bodyOf(std::uint32_t first) const { return parent_[first]; }

  std::size_t bytes() const { return parent_.bytes() + cell_end_.bytes(); }

 private:
  struct RowRange {
    int begin, end;
    bool holds(int row) const { return row >= begin && row < end; }
  };

  struct Step {
    std::int8_t x, y, z;
  };
  /// To the neighbours whose (z, y, x) comes before a cell's own. Those across a side first: theirs are the particles that are
  /// found near soonest, and through them the others are mostly joined already.
  static constexpr std::array<Step, 13> kLower{{{-1, 0, 0},
                                                {0, -1, 0},
                                                {0, 0, -1},
                                                {-1, -1, 0},
                                                {1, -1, 0},
                                                {-1, 0, -1},
                                                {1, 0, -1},
                                                {0, -1, -1},
                                                {0, 1, -1},
                                                {-1, -1, -1},
                                                {1, -1, -1},
                                                {-1, 1, -1},
                                                {1, 1, -1}}};

  template <class Visit>
  static void forEachCell(const GridView<Real>& view, const RowRange& rows, Visit&& visit) {
    for (int row = rows.begin; row < rows.end; ++row) {
      if (view.rowBegin(row) == view.rowEnd(row)) continue;
      for (int x = 1; x < view.size[0] - 1; ++x) {
        const std::uint32_t first = view.start[view.cell(row, x)];
        const std::uint32_t end = view.start[view.cell(row, x) + 1];
        if (first != end) visit(row, x, first, end);
      }
    }
  }

  /// Joins a cell with those of its 13 lower neighbours whose row `wanted` takes.
  template <class Wanted>
  void linkCell(const GridView<Real>& view, const Particles<Real>& p, int row, int x, std::uint32_t first, Wanted&& wanted) {
    const int y = row % view.size[1];
    const int z = row / view.size[1];
    std::uint32_t root = rootOf(first);
    for (const Step& step : kLower) {
      const int other_z = wrapped(view, 2, z + step.z);
      const int other_y = wrapped(view, 1, y + step.y);
      const int other_x = wrapped(view, 0, x + step.x);
      const int other_row = other_z * view.size[1] + other_y;
      if (!wanted(other_row)) continue;
      const std::uint32_t other = view.start[view.cell(other_row, other_x)];
      const std::uint32_t other_end = view.start[view.cell(other_row, other_x) + 1];
      if (other == other_end) continue;
      const std::uint32_t other_root = rootOf(other);
      if (root == other_root || !near(view, p, first, cell_end_[first], other, other_end)) continue;
      parent_[std::max(root, other_root)] = std::min(root, other_root);
      root = std::min(root, other_root);
    }
    parent_[first] = root;
  }

  static int wrapped(const GridView<Real>& view, std::size_t axis, int c) {
    if (!view.periodic[axis]) return c;
    const int last = view.size[axis] - 2;
    return c < 1 ? last : c > last ? 1 : c;
  }

  std::uint32_t rootOf(std::uint32_t cell) {
    while (parent_[cell] != cell) {
      parent_[cell] = parent_[parent_[cell]];
      cell = parent_[cell];
    }
    return cell;
  }

  static bool near(const GridView<Real>& view, const Particles<Real>& p, std::uint32_t first, std::uint32_t end,
                   std::uint32_t other, std::uint32_t other_end) {
    for (std::uint32_t i = first; i < end; ++i) {
      for (std::uint32_t j = other; j < other_end; ++j) {
        const Real dx = nearest(view, 0, p.x[j] - p.x[i]);
        const Real dy = nearest(view, 1, p.y[j] - p.y[i]);
        const Real dz = nearest(view, 2, p.z[j] - p.z[i]);
        if (dx * dx + dy * dy + dz * dz < Real(1)) return true;
      }
    }
    return false;
  }
  static Real nearest(const GridView<Real>& view, std::size_t axis, Real d) {
    return view.periodic[axis] ? d - view.period[axis] * std::nearbyint(d / view.period[axis]) : d;
  }

  AlignedArray<std::uint32_t> parent_;    // of the cell whose first particle this is
  AlignedArray<std::uint32_t> cell_end_;  // likewise
};

}  // namespace bleedsim::sph
