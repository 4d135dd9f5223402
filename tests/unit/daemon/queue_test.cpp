#include <gtest/gtest.h>
#include <memory>
#include <thread>

#include "service/daemon/bounded_queue.h"
#include "service/daemon/command_queue.h"
#include "service/daemon/journal.h"

namespace bleedsim::daemon {
namespace {

TEST(BoundedQueue, RefusesWhenFullAndLeavesTheValue) {
  BoundedQueue<std::unique_ptr<int>> queue{2};
  EXPECT_TRUE(queue.tryPush(std::make_unique<int>(1)));
  EXPECT_TRUE(queue.tryPush(std::make_unique<int>(2)));
  auto third = std::make_unique<int>(3);
  EXPECT_FALSE(queue.tryPush(std::move(third)));
  ASSERT_NE(third, nullptr);  // NOLINT(bugprone-use-after-move): a refused value is not moved from
  EXPECT_EQ(queue.room(), 0U);
  std::unique_ptr<int> out;
  for (int expected = 1; expected <= 2; ++expected) {
    ASSERT_TRUE(queue.tryPop(out));
    EXPECT_EQ(*out, expected);
  }
  EXPECT_FALSE(queue.tryPop(out));
  EXPECT_TRUE(queue.empty());
}

TEST(BoundedQueue, LeavesSlotsToOthers) {
  BoundedQueue<int> queue{3};
  EXPECT_TRUE(queue.tryPush(1, 2));
  EXPECT_FALSE(queue.tryPush(2, 2));
  EXPECT_EQ(queue.room(), 2U);
  EXPECT_TRUE(queue.tryPush(2));
  EXPECT_TRUE(queue.tryPush(3));
  EXPECT_FALSE(queue.tryPush(4));
  EXPECT_FALSE(queue.tryPush(4, 4));
}

TEST(BoundedQueue, KeepsTheOrderBetweenThreads) {
  constexpr int kCount = 50'000;
  BoundedQueue<int> queue{64};
  std::thread writer{[&queue] {
    for (int i = 0; i < kCount;) {
      if (queue.tryPush(int{i})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  }};
  int expected = 0;
  for (int value = 0; expected < kCount;) {
    if (!queue.tryPop(value)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(value, expected);
    ++expected;
  }
  writer.join();
}

TEST(CommandQueue, HoldsABoundedNumberOfInputs) {
  CommandQueue queue;
  for (std::size_t i = 0; i < CommandQueue::kCapacity; ++i) ASSERT_TRUE(queue.tryPush(WriterLost{i, i}));
  EXPECT_FALSE(queue.tryPush(WriterLost{0, 0}));
}

TEST(CommandQueue, LimitsTheScenesThatWait) {
  CommandQueue queue;
  const auto load = [&queue](std::uint64_t sender) {
    dds::DecodedRequest request;
    request.sender = sender;
    request.action = dds::LoadScene{"text"};
    return queue.tryPush(std::move(request));
  };
  for (std::uint64_t sender = 1; sender <= CommandQueue::kMaxScenes; ++sender) {
    EXPECT_TRUE(load(sender));
    EXPECT_FALSE(load(sender)) << "one of each sender";
  }
  EXPECT_FALSE(load(99)) << "some of all";
  EXPECT_TRUE(queue.tryPush(WriterLost{1, 1})) << "other inputs have room";
  Input out;
  ASSERT_TRUE(queue.tryPop(out));
  EXPECT_TRUE(load(99)) << "a scene that was taken makes room";
  EXPECT_FALSE(load(2));
}

TEST(CommandQueue, ASenderWithManyWritersIsOne) {
  CommandQueue queue;
  std::size_t taken = 0;
  for (std::uint64_t writer = 0; writer < CommandQueue::kCapacity; ++writer)
    taken += queue.tryPush(WriterLost{writer, 1}) ? 1 : 0;
  EXPECT_EQ(taken, CommandQueue::kCapacity / 2);
}

TEST(Wakeup, KeepsANotificationUntilSomeoneWaits) {
  Wakeup wakeup;
  wakeup.notify();
  EXPECT_TRUE(wakeup.wait({}));
  EXPECT_FALSE(wakeup.wait(Clock::now()));
}

TEST(Journal, ALostEntryLeavesAGapInTheNumbers) {
  Journal journal{2};
  journal.beginEpoch(4);
  EXPECT_TRUE(journal.append(10, 0.1, dds::Decision{"a"}));
  EXPECT_TRUE(journal.append(11, 0.1, dds::Decision{"b"}));
  EXPECT_FALSE(journal.append(12, 0.1, dds::Decision{"c"}));
  dds::JournalEntry entry;
  ASSERT_TRUE(journal.tryPop(entry));
  ASSERT_TRUE(journal.tryPop(entry));
  EXPECT_EQ(entry.number, 2U);
  EXPECT_TRUE(journal.append(13, 0.1, dds::Decision{"d"}));
  ASSERT_TRUE(journal.tryPop(entry));
  EXPECT_EQ(entry.number, 4U);
  EXPECT_EQ(entry.epoch, 4U);
}

}  // namespace
}  // namespace bleedsim::daemon
