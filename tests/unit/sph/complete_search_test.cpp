// WorldOptions::complete_search: the same world without the cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kAnyStep = std::numeric_limits<double>::infinity();
constexpr int kSteps = 3;

/// Positions by id after kSteps, m.
std::vector<Vec3> positionsAfterSteps(World& world) {
  for (int step = 0; step < kSteps; ++step) EXPECT_TRUE(world.step(kAnyStep).ok());
  const FrameBuffer frame = test::frameOf(world);
  std::vector<Vec3> positions(frame.count);
  for (std::size_t i = 0; i < frame.count; ++i) positions[frame.id[i] - 1] = test::positionOf(frame, i);
  return positions;
}

/// Neighbours are summed in another order: forces differ by rounding, 1e-6 of them, which moves nothing by 1e-5 spacings in three
/// steps. A missed neighbour would show: at the edge of its reach alone it makes 1e-4 of the density.
void expectSameAsCells(const test::Counts& counts, bool lists) {
  const WorldDescription description = test::hydrostaticColumn(counts, 0.0035);
  const auto cells = test::makeWorld(description);
  const auto complete = test::makeWorld(description, {.complete_search = true});
  const std::vector<Vec3> expected = positionsAfterSteps(*cells);
  const std::vector<Vec3> found = positionsAfterSteps(*complete);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT((found[i] - expected[i]).norm(), 1e-5 * test::kSpacing) << i;
  EXPECT_EQ(test::counterOf(*cells, Counter::neighbor_overflow), 0u);
  const std::uint64_t searches = (kSteps + 1) * std::uint64_t{complete->particleCount()};
  EXPECT_EQ(test::counterOf(*complete, Counter::neighbor_overflow), lists ? 0u : searches);
}

TEST(CompleteSearch, OfFewParticlesFindsTheNeighboursOfTheCells) { expectSameAsCells({8, 8, 8}, true); }
TEST(CompleteSearch, OfManyParticlesFindsTheNeighboursOfTheCells) { expectSameAsCells({13, 13, 13}, false); }

TEST(CompleteSearch, IsRefusedWithPeriodicSides) {
  const auto world = createWorld(test::periodicBox({8, 8, 8}), {.complete_search = true});
  ASSERT_FALSE(world.ok());
  EXPECT_THAT(world.status().message(), testing::HasSubstr("periodic"));
}

}  // namespace
}  // namespace bleedsim::sph
