// The cell grid against brute force: which particles the runs of a cell hold, and in which order the sort leaves them.
#include "service/sph/neighbors/cell_grid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

#include "service/sph/seeding.h"

namespace bleedsim::sph {
namespace {

using Point = std::array<double, 3>;
using Periodic = std::array<bool, 3>;

/// Points in support radii, and the order in which the grid stored them.
struct Sorted {
  CellGrid<double> grid;
  std::vector<std::uint32_t> order;
  std::uint32_t count = 0;
};

Sorted sortPoints(const std::vector<Point>& points, const Point& sides, const Periodic& periodic, int shares = 1,
                  const std::vector<std::uint32_t>& removed = {}, double cell = 1.0, double largest_cell = 1.0) {
  const auto n = static_cast<std::uint32_t>(points.size());
  const auto executor = makeExecutor(shares);
  Sorted sorted{CellGrid<double>{std::max(n, 1u), {0.0, 0.0, 0.0}, sides, periodic, 1.0, shares, largest_cell}, {}, 0};
  Bounds<double> bounds;
  for (const Point& p : points) bounds.include(p[0], p[1], p[2]);
  sorted.grid.cover(bounds, cell);
  for (std::uint32_t i = 0; i < n; ++i) sorted.grid.cells()[i] = sorted.grid.cellAt(points[i][0], points[i][1], points[i][2]);
  for (const std::uint32_t i : removed) sorted.grid.cells()[i] = CellGrid<double>::kRemoved;
  sorted.order.resize(n);
  sorted.count = sorted.grid.sort(n, shares, *executor, [&](std::uint32_t from, std::uint32_t to) { sorted.order[to] = from; });
  sorted.order.resize(sorted.count);
  return sorted;
}

std::vector<Point> randomPoints(int count, const Point& sides) {
  JitterSource random{3};
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) {
    Point p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = 0.5 * sides[a] * (1.0 + random.next());
    points.push_back(p);
  }
  return points;
}

template <bool kPeriodic>
void expectRunsHoldTheNeighbors(const Sorted& sorted, const std::vector<Point>& points, const Point& sides,
                                const Periodic& periodic) {
  const GridView<double>& view = sorted.grid.view();
  for (int row = 0; row < view.rows(); ++row) {
    for (int cx = 1; cx < view.size[0] - 1; ++cx) {
      const std::uint32_t begin = view.start[view.cell(row, cx)];
      const std::uint32_t end = view.start[view.cell(row, cx) + 1];
      if (begin == end) continue;
      NeighborRun<double> runs[GridView<double>::kMaxRuns];
      const int run_count = view.neighborRuns<kPeriodic>(row, cx, runs);
      ASSERT_LE(run_count, GridView<double>::kMaxRuns);
      for (std::uint32_t k = begin; k < end; ++k) {
        const Point& own = points[sorted.order[k]];
        std::vector<int> seen(points.size(), 0);
        std::vector<int> near(points.size(), 0);
        for (int r = 0; r < run_count; ++r) {
          const Point shift{runs[r].shift_x, runs[r].shift_y, runs[r].shift_z};
          for (std::uint32_t j = runs[r].begin; j < runs[r].end; ++j) {
            const std::uint32_t other = sorted.order[j];
            double squared = 0.0;
            for (std::size_t a = 0; a < 3; ++a) {
              const double d = points[other][a] + shift[a] - own[a];
              ASSERT_LT(std::abs(d), 2.7) << "not of the 27 cells";
              squared += d * d;
            }
            ++seen[other];
            near[other] += squared < 1.0 ? 1 : 0;
          }
        }
        for (std::size_t j = 0; j < points.size(); ++j) {
          double squared = 0.0;
          for (std::size_t a = 0; a < 3; ++a) {
            double d = points[j][a] - own[a];
            if (periodic[a]) d -= sides[a] * std::round(d / sides[a]);
            squared += d * d;
          }
          ASSERT_EQ(near[j], squared < 1.0 ? 1 : 0) << "particle " << j << " of the cell at row " << row << ", x " << cx;
          ASSERT_LE(seen[j], 1) << "a cell stands in two runs";
        }
      }
    }
  }
}

class CellGridRuns : public testing::TestWithParam<int> {};

TEST_P(CellGridRuns, HoldEveryNeighborOnce) {
  const int mask = GetParam();
  const Periodic periodic{(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0};
  for (const Point& sides : {Point{3.0, 3.0, 3.0}, Point{3.9, 4.2, 5.5}, Point{6.0, 3.01, 4.0}}) {
    const std::vector<Point> points = randomPoints(400, sides);
    const Sorted sorted = sortPoints(points, sides, periodic);
    ASSERT_EQ(sorted.count, points.size());
    if (mask == 0)
      expectRunsHoldTheNeighbors<false>(sorted, points, sides, periodic);
    else
      expectRunsHoldTheNeighbors<true>(sorted, points, sides, periodic);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryPeriodicity, CellGridRuns, testing::Range(0, 8));

TEST(CellGrid, SortsByCellAndKeepsTheOrderWithinACell) {
  const Point sides{5.0, 4.0, 6.0};
  const std::vector<Point> points = randomPoints(3000, sides);
  const Sorted sorted = sortPoints(points, sides, {false, false, false});
  ASSERT_EQ(sorted.count, 3000u);
  std::uint32_t last_cell = 0;
  for (std::uint32_t k = 0; k < sorted.count; ++k) {
    const Point& p = points[sorted.order[k]];
    const std::uint32_t cell = sorted.grid.cellAt(p[0], p[1], p[2]);
    ASSERT_GE(cell, last_cell);
    if (k > 0 && cell == last_cell) { ASSERT_GT(sorted.order[k], sorted.order[k - 1]); }
    ASSERT_GE(k, sorted.grid.view().start[cell]);
    ASSERT_LT(k, sorted.grid.view().start[cell + 1]);
    last_cell = cell;
  }
}

// Far from the origin in single precision, where the cells' places are rounded; also beyond the margin and across periodic sides.
TEST(CellGrid, BoundsOfACellHoldItsParticles) {
  for (const Periodic& periodic : {Periodic{false, false, false}, Periodic{true, false, true}}) {
    for (const double cell : {1.0, 1.13}) {
      const double away = 5000.0;
      CellGrid<float> grid{3000, {away, 0.0, -3.0}, {away + 700.0, 3.0, 0.0}, periodic, 1.0, 1, 1.3};
      JitterSource random{7};
      std::vector<std::array<float, 3>> points;
      Bounds<float> bounds;
      for (int k = 0; k < 3000; ++k) {
        const auto within = [&random](double from, double side) {
          return static_cast<float>(from + 0.5 * side * (1.0 + random.next()));
        };
        std::array<float, 3> p{within(away, 700.0), within(0.0, 3.0), within(-3.0, 3.0)};
        if (k % 100 == 0 && !periodic[0]) p[0] += 20.0F;
        if (k % 70 == 0) p[1] -= 5.0F;
        points.push_back(p);
        bounds.include(p[0], p[1], p[2]);
      }
      grid.cover(bounds, static_cast<float>(cell));
      for (const auto& p : points) {
        Bounds<float> of_cell;
        for (std::size_t a = 0; a < 3; ++a) {
          const int c = grid.coordinate(a, p[a]);
          grid.narrow(a, c, of_cell);
          ASSERT_GE(p[a], of_cell.lower[a]) << "axis " << a << ", cell " << c;
          ASSERT_LE(p[a], of_cell.upper[a]) << "axis " << a << ", cell " << c;
          const bool outermost = c == 1 || c == grid.view().size[a] - 2;
          if (!outermost) { ASSERT_LT(of_cell.upper[a] - of_cell.lower[a], 1.6F) << "no wider than it must be"; }
        }
      }
    }
  }
}

// What a sort moves in one go, taken apart, is the sort.
TEST(CellGrid, RunsAreTheSortTakenTogether) {
  const Point sides{5.0, 4.0, 6.0};
  std::vector<Point> points = randomPoints(3000, sides);
  const Sorted first = sortPoints(points, sides, {false, false, false});
  std::vector<Point> in_order;
  for (const std::uint32_t i : first.order) in_order.push_back(points[i]);
  std::swap(in_order[17], in_order[2400]);
  for (const int shares : {1, 3}) {
    const auto n = static_cast<std::uint32_t>(points.size());
    const std::vector<std::uint32_t> removed{0, 5, 6, 1500, n - 1};
    Sorted sorted = sortPoints(in_order, sides, {false, false, false}, shares, removed);
    std::vector<std::uint32_t> order(n, n);
    std::atomic<std::uint32_t> longest{0};
    const auto executor = makeExecutor(shares);
    const std::uint32_t count =
        sorted.grid.sortRuns(n, shares, *executor, [&](std::uint32_t from, std::uint32_t to, std::uint32_t length) {
          for (std::uint32_t k = 0; k < length; ++k) order[to + k] = from + k;
          if (length > longest) longest = length;
        });
    order.resize(count);
    EXPECT_EQ(order, sorted.order) << shares << " shares";
    EXPECT_GT(longest, 30u) << "sorted particles keep together";
  }
}

// Two particles within `cell` of each other stand in neighbouring cells, whatever the largest cell.
TEST(CellGrid, CellsFollowTheSearch) {
  const Point sides{5.0, 4.1, 6.0};
  const std::vector<Point> points = randomPoints(400, sides);
  for (const Periodic& periodic : {Periodic{false, false, false}, Periodic{true, false, true}, Periodic{true, true, true}}) {
    for (const double cell : {1.0, 1.13, 1.3}) {
      const Sorted sorted = sortPoints(points, sides, periodic, 1, {}, cell, 1.3);
      std::vector<std::array<int, 3>> at(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t a = 0; a < 3; ++a) at[i][a] = sorted.grid.coordinate(a, points[i][a]);
      for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          for (std::size_t a = 0; a < 3; ++a) {
            const int cells = sorted.grid.view().size[a] - 2;
            double apart = std::abs(points[i][a] - points[j][a]);
            int steps = std::abs(at[i][a] - at[j][a]);
            if (periodic[a]) apart = std::min(apart, sides[a] - apart);
            if (periodic[a]) steps = std::min(steps, cells - steps);
            if (apart < cell) { ASSERT_LE(steps, 1) << "axis " << a; }
          }
        }
      }
      for (std::size_t a = 0; a < 3; ++a) EXPECT_GE(sorted.grid.view().size[a], periodic[a] ? 5 : 3);
    }
  }
}

// The same particles, and one more far away: the others keep their order.
TEST(CellGrid, OrderDoesNotDependOnTheBounds) {
  const Point sides{40.0, 40.0, 40.0};
  std::vector<Point> points = randomPoints(500, {5.0, 6.0, 7.0});
  for (Point& p : points)
    for (double& x : p) x += 17.3;
  for (const double cell : {1.0, 1.07, 1.3}) {
    const std::vector<std::uint32_t> alone = sortPoints(points, sides, {}, 1, {}, cell, 1.3).order;
    std::vector<Point> with = points;
    with.push_back({1.9, 2.8, 0.3});
    std::vector<std::uint32_t> order = sortPoints(with, sides, {}, 1, {}, cell, 1.3).order;
    order.erase(std::find(order.begin(), order.end(), 500u));
    EXPECT_EQ(order, alone) << cell;
  }
}

TEST(CellGrid, OrderDoesNotDependOnTheNumberOfShares) {
  const Point sides{5.0, 4.0, 6.0};
  const std::vector<Point> points = randomPoints(1001, sides);
  const Sorted one = sortPoints(points, sides, {true, false, true});
  for (int shares = 2; shares <= 4; ++shares) {
    EXPECT_EQ(sortPoints(points, sides, {true, false, true}, shares).order, one.order) << shares << " shares";
  }
}

TEST(CellGrid, DropsRemovedParticles) {
  const Point sides{4.0, 4.0, 4.0};
  const std::vector<Point> points = randomPoints(100, sides);
  const Sorted sorted = sortPoints(points, sides, {false, false, false}, 3, {0, 17, 50, 99});
  EXPECT_EQ(sorted.count, 96u);
  for (const std::uint32_t removed : {0u, 17u, 50u, 99u}) {
    EXPECT_EQ(std::count(sorted.order.begin(), sorted.order.end(), removed), 0);
  }
  std::vector<std::uint32_t> all(100);
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_EQ(sortPoints(points, sides, {false, false, false}, 2, all).count, 0u);
}

TEST(CellGrid, HoldsNothingOrOneParticleOrTheCorners) {
  const Point sides{4.0, 5.0, 6.0};
  for (const Periodic& periodic : {Periodic{false, false, false}, Periodic{true, true, true}}) {
    EXPECT_EQ(sortPoints({}, sides, periodic, 2).count, 0u);
    EXPECT_EQ(sortPoints({{1.0, 2.0, 3.0}}, sides, periodic, 2).count, 1u);
    std::vector<Point> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({(k & 1) != 0 ? 4.0 : 0.0, (k & 2) != 0 ? 5.0 : 0.0, (k & 4) != 0 ? 6.0 : 0.0});
    EXPECT_EQ(sortPoints(corners, sides, periodic, 2).count, 8u);
  }
}

TEST(CellGrid, ParticlesBeyondTheMarginFallIntoTheOutermostCells) {
  const Sorted sorted = sortPoints({{2.0, 2.0, 2.0}, {2.0, 2.0, -500.0}, {900.0, 2.0, 2.0}}, {4.0, 4.0, 4.0}, {});
  EXPECT_EQ(sorted.count, 3u);
  EXPECT_LE(sorted.grid.view().size[0], 9);
  EXPECT_LE(sorted.grid.view().size[2], 9);
}

TEST(CellGrid, SplitsRowsIntoSharesThatCoverAllParticles) {
  const Point sides{5.0, 7.0, 9.0};
  const std::vector<Point> points = randomPoints(2000, sides);
  const Sorted sorted = sortPoints(points, sides, {});
  for (int shares = 1; shares <= 4; ++shares) {
    EXPECT_EQ(sorted.grid.firstRow(0, shares, sorted.count), 0);
    EXPECT_EQ(sorted.grid.firstRow(shares, shares, sorted.count), sorted.grid.view().rows());
    for (int share = 0; share < shares; ++share) {
      const int first = sorted.grid.firstRow(share, shares, sorted.count);
      const int last = sorted.grid.firstRow(share + 1, shares, sorted.count);
      ASSERT_LE(first, last);
      const std::uint32_t held = sorted.grid.view().rowBegin(last) - sorted.grid.view().rowBegin(first);
      EXPECT_NEAR(held, 2000.0 / shares, 120.0);
    }
  }
}

}  // namespace
}  // namespace bleedsim::sph
