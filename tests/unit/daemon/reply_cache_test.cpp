#include "service/daemon/reply_cache.h"

#include <gtest/gtest.h>

namespace bleedsim::daemon {
namespace {

using Known = ReplyCache::Known;

dds::RequestKey key(std::uint64_t seq, std::uint8_t client = 1, std::uint64_t run = 1) { return {{dds::Uuid{client}, run}, seq}; }

dds::Reply replyFor(const dds::RequestKey& request, std::uint64_t step) {
  dds::Reply reply;
  reply.key = request;
  reply.applied_step = step;
  return reply;
}

TEST(ReplyCache, GivesTheFirstReplyAgain) {
  ReplyCache cache;
  EXPECT_EQ(cache.begin(key(1), 1).known, Known::fresh);
  EXPECT_EQ(cache.begin(key(1), 1).known, Known::in_work);
  cache.finish(replyFor(key(1), 33));
  const ReplyCache::Answer again = cache.begin(key(1), 1);
  ASSERT_EQ(again.known, Known::answered);
  EXPECT_EQ(again.reply->applied_step, 33U);
}

TEST(ReplyCache, ANewRunStartsAfresh) {
  ReplyCache cache;
  cache.begin(key(1), 1);
  EXPECT_EQ(cache.begin(key(1, 1, 2), 1).known, Known::fresh);
  EXPECT_EQ(cache.begin(key(1, 2, 1), 1).known, Known::fresh);
}

TEST(ReplyCache, RequestsOlderThanTheKeptOnesAreStale) {
  ReplyCache cache;
  for (std::uint64_t seq = 1; seq <= ReplyCache::kRequests + 2; ++seq) {
    ASSERT_EQ(cache.begin(key(seq), 1).known, Known::fresh);
    cache.finish(replyFor(key(seq), seq));
  }
  EXPECT_EQ(cache.begin(key(2), 1).known, Known::stale);
  EXPECT_EQ(cache.begin(key(3), 1).known, Known::answered);
}

TEST(ReplyCache, ARequestThatOvertookAnotherDoesNotMakeItStale) {
  ReplyCache cache;
  cache.begin(key(5), 1);
  EXPECT_EQ(cache.begin(key(4), 1).known, Known::fresh);
}

TEST(ReplyCache, AForgottenRequestIsFreshAgain) {
  ReplyCache cache;
  cache.begin(key(1), 1);
  cache.forget(key(1));
  EXPECT_EQ(cache.begin(key(1), 1).known, Known::fresh);
}

TEST(ReplyCache, KeepsABoundedNumberOfClientsAndForgetsTheQuietest) {
  ReplyCache cache;
  for (std::uint64_t run = 1; run <= ReplyCache::kClients; ++run) cache.begin(key(1, 1, run), 1);
  cache.begin(key(1, 1, 1), 1);
  cache.begin(key(1, 1, 9999), 1);
  EXPECT_EQ(cache.clientCount(), ReplyCache::kClients);
  EXPECT_EQ(cache.begin(key(1, 1, 1), 1).known, Known::in_work);
  EXPECT_EQ(cache.begin(key(1, 1, 2), 1).known, Known::fresh);
}

TEST(ReplyCache, WhoMakesUpStartsPushesOutHisOwn) {
  ReplyCache cache;
  cache.begin(key(1, 1), 1);
  for (std::uint64_t run = 1; run <= 3 * ReplyCache::kClients; ++run) cache.begin(key(1, 2, run), 2);
  EXPECT_EQ(cache.clientCount(), ReplyCache::kClients);
  EXPECT_EQ(cache.begin(key(1, 1), 1).known, Known::in_work);
  EXPECT_EQ(cache.begin(key(1, 2, 3 * ReplyCache::kClients), 2).known, Known::in_work);
}

TEST(ReplyCache, CountsTheNumbersThatWereLeftOut) {
  ReplyCache cache;
  EXPECT_EQ(cache.begin(key(7), 1).missed, 0U)
      << "a start that was forgotten, or that the session did not hear from its beginning";
  EXPECT_EQ(cache.begin(key(8), 1).missed, 0U);
  EXPECT_EQ(cache.begin(key(12), 1).missed, 3U);
  EXPECT_EQ(cache.begin(key(10), 1).missed, 0U) << "one of them";
  EXPECT_EQ(cache.begin(key(13), 1).missed, 0U);
}

}  // namespace
}  // namespace bleedsim::daemon
