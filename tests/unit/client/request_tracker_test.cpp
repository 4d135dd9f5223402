#include "clients/lib/request_tracker.h"

#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::client {
namespace {

constexpr Uuid kClient{1, 2, 3};
constexpr std::uint64_t kRun = 77;
constexpr std::int64_t kTimeout = 10'000'000'000;

class RequestTrackerTest : public testing::Test {
 protected:
  std::future<Reply> add(std::int64_t now) { return tracker_.add(std::make_shared<OwnedRequest>(), now, kTimeout); }
  static bool answered(const std::future<Reply>& future) {
    return future.wait_for(std::chrono::seconds{0}) == std::future_status::ready;
  }

  RequestTracker tracker_{kClient, kRun};
};

TEST_F(RequestTrackerTest, NumbersFromOneAndNamesClientAndRun) {
  auto first = add(0);
  auto second = add(0);
  const auto due = tracker_.due(0);
  ASSERT_EQ(due.size(), 2U);
  EXPECT_EQ(due[0]->wire.seq, 1U);
  EXPECT_EQ(due[1]->wire.seq, 2U);
  EXPECT_EQ(due[0]->wire.run, kRun);
  EXPECT_EQ(due[0]->wire.client[2], 3);
}

TEST_F(RequestTrackerTest, SendsTheSameAgainLessAndLessOften) {
  auto future = add(0);
  ASSERT_EQ(tracker_.due(0).size(), 1U);
  EXPECT_EQ(tracker_.nextEvent(), RequestTracker::kFirstResendNs);
  EXPECT_TRUE(tracker_.due(RequestTracker::kFirstResendNs - 1).empty());
  const auto again = tracker_.due(RequestTracker::kFirstResendNs);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0]->wire.seq, 1U);
  EXPECT_EQ(tracker_.nextEvent(), 3 * RequestTracker::kFirstResendNs);
  std::int64_t last = tracker_.nextEvent();
  for (int i = 0; i < 6; ++i) {
    tracker_.due(last);
    const std::int64_t next = tracker_.nextEvent();
    EXPECT_LE(next - last, RequestTracker::kLongestResendNs);
    last = next;
  }
}

TEST_F(RequestTrackerTest, ResolvesOnlyItsOwnReplies) {
  auto future = add(0);
  EXPECT_FALSE(tracker_.resolve(Uuid{9}, kRun, 1, {}));
  EXPECT_FALSE(tracker_.resolve(kClient, kRun + 1, 1, {}));
  EXPECT_FALSE(tracker_.resolve(kClient, kRun, 2, {}));
  EXPECT_FALSE(answered(future));
  EXPECT_TRUE(tracker_.resolve(kClient, kRun, 1, {.code = ReplyCode::accepted, .applied_step = 12}));
  ASSERT_TRUE(answered(future));
  const Reply reply = future.get();
  EXPECT_TRUE(reply.accepted());
  EXPECT_EQ(reply.applied_step, 12U);
  EXPECT_FALSE(tracker_.resolve(kClient, kRun, 1, {})) << "the reply to a request sent twice";
  EXPECT_TRUE(tracker_.due(std::numeric_limits<std::int64_t>::max() / 2).empty());
}

TEST_F(RequestTrackerTest, EndsWhatGetsNoAnswer) {
  auto future = add(5);
  tracker_.expire(4 + kTimeout);
  EXPECT_FALSE(answered(future));
  tracker_.expire(5 + kTimeout);
  ASSERT_TRUE(answered(future));
  EXPECT_EQ(future.get().code, ReplyCode::no_answer);
  EXPECT_EQ(tracker_.nextEvent(), std::numeric_limits<std::int64_t>::max());
}

TEST_F(RequestTrackerTest, IsBounded) {
  std::vector<std::future<Reply>> futures;
  for (std::size_t i = 0; i < RequestTracker::kMaxPending; ++i) futures.push_back(add(0));
  auto full = add(0);
  ASSERT_TRUE(answered(full));
  EXPECT_EQ(full.get().code, ReplyCode::not_sent);
  EXPECT_EQ(tracker_.pending(), RequestTracker::kMaxPending);
  tracker_.endAll("closed");
  for (auto& future : futures) EXPECT_EQ(future.get().reason, "closed");
}

}  // namespace
}  // namespace bleedsim::client
