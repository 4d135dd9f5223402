#include "service/sph/passes/list_stretches.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace bleedsim::sph {
namespace {

constexpr std::uint32_t kChunk = ListStretches::kChunk;

/// What PairPasses::densityAndSweep() does with the room: rows of equally many particles, lists of equal length, a walk that
/// stays `lag` rows behind.
class Room {
 public:
  Room(std::size_t capacity, int rows, std::uint32_t particles) : particles_{particles}, stretches_{capacity} {
    for (int row = 0; row <= rows; ++row) start_.push_back(static_cast<std::uint32_t>(row) * particles);
    view_.start = start_.data();
    view_.size = {1, rows, 1};
    lists_.end = capacity;
  }

  /// Rows from `first` on are walked; `length` entries a particle.
  void sweep(int first, int lag, std::size_t length) {
    live_.clear();
    const int rows = view_.size[1];
    stretches_.begin(view_, 0, rows, first, lists_);
    int walked = first;
    for (int row = 0; row < rows;) {
      const int end = view_.rowsWith(kChunk, row, rows);
      stretches_.prepare(row, walked, lists_);
      for (int r = row; r < end; ++r) store(r, length);
      stretches_.note(row, end, lists_);
      row = end;
      for (; walked < row - lag; ++walked) live_.erase(walked);
    }
  }

  std::size_t highest() const { return highest_; }
  int overflowed() const { return overflowed_; }
  bool intact() const { return intact_; }

 private:
  void store(int row, std::size_t length) {
    for (std::uint32_t k = 0; k < particles_; ++k) {
      if (lists_.used + 2 * kMaxNeighbors > lists_.end && !lists_.goOn()) {
        ++overflowed_;
        continue;
      }
      for (const auto& [other, lists] : live_) {
        for (const std::size_t at : lists) intact_ = intact_ && (lists_.used + length <= at || at + length <= lists_.used);
      }
      live_[row].push_back(lists_.used);
      lists_.used += length;
      highest_ = std::max(highest_, lists_.used);
    }
  }

  std::uint32_t particles_;
  std::vector<std::uint32_t> start_;
  GridView<float> view_;
  NeighborLists<float> lists_;
  ListStretches stretches_;
  std::map<int, std::vector<std::size_t>> live_;  // where the lists of a row stand that a walk has still to read
  std::size_t highest_ = 0;
  int overflowed_ = 0;
  bool intact_ = true;
};

constexpr std::size_t kStretch = (64 + kChunk + 2) * kMaxNeighbors;  // of rows of 64 particles

// 320 rows of 64 lists of 32 entries: 5.9 stretches in one go, of which a walk ten rows behind leaves one and a bit at work.
TEST(ListStretches, ListsBehindTheWalkAreWrittenAgain) {
  Room room{8 * kStretch, 320, 64};
  room.sweep(0, 10, 32);
  EXPECT_TRUE(room.intact());
  EXPECT_EQ(room.overflowed(), 0);
  EXPECT_LE(room.highest(), 2 * kStretch);
  room.sweep(0, 10, 32);
  EXPECT_TRUE(room.intact()) << "the next step";
  EXPECT_LE(room.highest(), 2 * kStretch);
}

TEST(ListStretches, RowsThatWaitForAnotherShareKeepTheirLists) {
  Room room{8 * kStretch, 320, 64};
  room.sweep(100, 10, 32);
  EXPECT_TRUE(room.intact());
  EXPECT_EQ(room.overflowed(), 0);
  EXPECT_LT(room.highest(), 5 * kStretch);
}

// A film: the walk begins when all densities are known. Only what does not fit the room at all overflows.
TEST(ListStretches, AWalkFarBehindGetsTheWholeRoom) {
  Room room{8 * kStretch, 320, 64};
  room.sweep(0, 320, 32);
  EXPECT_TRUE(room.intact());
  EXPECT_EQ(room.overflowed(), 0);
  EXPECT_GE(room.highest(), std::size_t{320} * 64 * 32);
  Room full{6 * kStretch, 320, 64};
  full.sweep(0, 320, 40);
  EXPECT_TRUE(full.intact());
  const auto fits = static_cast<int>(6 * kStretch / 40);
  EXPECT_GE(full.overflowed(), 320 * 64 - fits);
  EXPECT_LE(full.overflowed(), 320 * 64 - fits + 6 * 2 * static_cast<int>(kMaxNeighbors) / 40 + 6);
}

// Rows so long, or so little room, that there would be hardly any stretches.
TEST(ListStretches, TooFewStretchesAreOne) {
  Room room{std::size_t{4} * 4000 * kMaxNeighbors, 8, 4000};
  room.sweep(0, 1, 32);
  EXPECT_TRUE(room.intact());
  EXPECT_EQ(room.overflowed(), 0);
  EXPECT_EQ(room.highest(), std::size_t{8} * 4000 * 32);
  Room empty{1000, 0, 1};
  empty.sweep(0, 1, 32);
  EXPECT_EQ(empty.highest(), 0u);
}

// Lists may be six times as long as usual: a chunk still finds what it needs, in its own stretch or in the one it goes on in.
TEST(ListStretches, TheLongestListsFit) {
  Room room{12 * kStretch, 100, 64};
  room.sweep(0, 4, kMaxNeighbors);
  EXPECT_TRUE(room.intact());
  EXPECT_EQ(room.overflowed(), 0);
}

}  // namespace
}  // namespace bleedsim::sph
