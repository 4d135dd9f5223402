#include "service/daemon/fair_queue.h"

#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <utility>

namespace bleedsim::daemon {
namespace {

TEST(FairQueue, KeepsTheOrderOfEachSenderAndLetsThemTakeTurns) {
  FairQueue<std::pair<int, int>> queue{16};
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(queue.tryPush(1, {1, i}));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(queue.tryPush(2, {2, i}));
  ASSERT_TRUE(queue.tryPush(3, {3, 0}));
  const std::pair<int, int> expected[] = {{1, 0}, {2, 0}, {3, 0}, {1, 1}, {2, 1}, {1, 2}, {1, 3}};
  for (const auto& next : expected) {
    std::pair<int, int> out;
    ASSERT_TRUE(queue.tryPop(out));
    EXPECT_EQ(out, next);
  }
  std::pair<int, int> out;
  EXPECT_FALSE(queue.tryPop(out));
  EXPECT_TRUE(queue.empty());
}

TEST(FairQueue, OneThatFloodsFillsHalfAndTheOthersFindRoom) {
  FairQueue<int> queue{1024};
  int taken = 0;
  for (int i = 0; i < 5000; ++i) taken += queue.tryPush(1, int{i}) ? 1 : 0;
  EXPECT_EQ(taken, 512);
  int second = 0;
  for (int i = 0; i < 5000; ++i) second += queue.tryPush(2, int{i}) ? 1 : 0;
  EXPECT_EQ(second, 256);
  int polite = 0;
  for (std::uint64_t sender = 10; sender < 100; ++sender) polite += queue.tryPush(sender, 0) ? 1 : 0;
  EXPECT_EQ(polite, 90);
  // The polite ones wait for one turn, not for the flood.
  int out = 0;
  int of_flood = 0;
  for (int i = 0; i < 92; ++i) {
    ASSERT_TRUE(queue.tryPop(out));
    of_flood += out > 0 ? 1 : 0;
  }
  EXPECT_LE(of_flood, 2);
}

TEST(FairQueue, RefusesWhenFullAndLeavesTheValue) {
  FairQueue<std::unique_ptr<int>> queue{2};
  EXPECT_TRUE(queue.tryPush(1, std::make_unique<int>(1)));
  EXPECT_TRUE(queue.tryPush(2, std::make_unique<int>(2)));
  auto third = std::make_unique<int>(3);
  EXPECT_FALSE(queue.tryPush(3, std::move(third)));
  ASSERT_NE(third, nullptr);  // NOLINT(bugprone-use-after-move): a refused value is not moved from
  std::unique_ptr<int> out;
  EXPECT_TRUE(queue.tryPop(out));
  EXPECT_TRUE(queue.tryPush(3, std::move(third)));
}

// Slots go round: many more values pass than there is room for.
TEST(FairQueue, PassesEverythingBetweenThreads) {
  constexpr int kCount = 20'000;
  FairQueue<std::pair<std::uint64_t, int>> queue{64};
  const auto send = [&queue](std::uint64_t sender) {
    for (int i = 0; i < kCount;) i += queue.tryPush(sender, {sender, i}) ? 1 : 0;
  };
  std::thread one{send, 1};
  std::thread two{send, 2};
  int expected[3] = {};
  std::pair<std::uint64_t, int> out;
  while (expected[1] + expected[2] < 2 * kCount) {
    if (!queue.tryPop(out)) continue;
    ASSERT_EQ(out.second, expected[out.first]++);
  }
  one.join();
  two.join();
}

}  // namespace
}  // namespace bleedsim::daemon
