// Gap counting and where frames wait.
#include <gtest/gtest.h>

#include "clients/lib/frame_box.h"
#include "clients/lib/gap_counter.h"

namespace bleedsim::client {
namespace {

constexpr Uuid kOne{1};
constexpr Uuid kTwo{2};

TEST(GapCounter, CountsEveryMissingNumberOnce) {
  GapCounter counter;
  EXPECT_EQ(counter.note(kOne, 7), 0U) << "joining late is no gap";
  EXPECT_EQ(counter.note(kOne, 8), 0U);
  EXPECT_EQ(counter.note(kOne, 12), 3U);
  EXPECT_EQ(counter.note(kOne, 12), 0U);
  EXPECT_EQ(counter.note(kOne, 10), 0U);
  EXPECT_EQ(counter.note(kOne, 13), 0U);
  EXPECT_EQ(counter.gaps(), 3U);
}

TEST(GapCounter, ANewSessionStartsAfresh) {
  GapCounter counter;
  counter.note(kOne, 1000);
  EXPECT_EQ(counter.note(kTwo, 1), 0U);
  EXPECT_EQ(counter.note(kTwo, 3), 1U);
}

TEST(GapCounter, KnowsWhatWasSentAndDidNotCome) {
  GapCounter counter;
  EXPECT_EQ(counter.overdue(), 0U);
  counter.told(kOne, 7);
  EXPECT_EQ(counter.overdue(), 1U) << "what was sent before nobody missed";
  counter.note(kOne, 7);
  EXPECT_EQ(counter.overdue(), 0U);
  counter.told(kOne, 10);
  EXPECT_EQ(counter.overdue(), 3U);
  EXPECT_EQ(counter.gaps(), 0U);
  counter.note(kOne, 11);
  EXPECT_EQ(counter.overdue(), 0U) << "it came before it was told of";
  EXPECT_EQ(counter.gaps(), 3U);
  counter.told(kTwo, 5);
  EXPECT_EQ(counter.overdue(), 1U) << "another session has numbers of its own";
  counter.note(kTwo, 5);
  EXPECT_EQ(counter.overdue(), 0U);
}

TEST(FrameBox, NewestWinsAndCountsWhatItDropped) {
  FrameBox box{1};
  EXPECT_EQ(box.take(), nullptr);
  const auto a = std::make_shared<const Frame>();
  const auto b = std::make_shared<const Frame>();
  box.put(a);
  box.put(b);
  EXPECT_EQ(box.take(), b);
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.dropped(), 1U);
}

TEST(FrameBox, AQueueGivesTheOldestFirstAndIsBounded) {
  FrameBox box{3};
  std::vector<FramePointer> all;
  for (int i = 0; i < 5; ++i) {
    all.push_back(std::make_shared<const Frame>());
    box.put(all.back());
  }
  EXPECT_EQ(box.dropped(), 2U);
  for (std::size_t i = 2; i < 5; ++i) EXPECT_EQ(box.take(), all[i]);
  EXPECT_EQ(box.take(), nullptr);
}

}  // namespace
}  // namespace bleedsim::client
