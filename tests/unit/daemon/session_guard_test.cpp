#include "service/daemon/session_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bleedsim::daemon {
namespace {

constexpr dds::Uuid kLow{1};
constexpr dds::Uuid kHigh{2};

TEST(SessionGuard, OfTwoNewDaemonsTheLowerUuidStays) {
  for (std::uint64_t own = 0; own < kEstablishedHeartbeat; ++own) {
    for (std::uint64_t other = 1; other < kEstablishedHeartbeat; ++other) {
      EXPECT_TRUE(mustGiveWay({kHigh, 10, own}, {kLow, 20, other}));
      EXPECT_FALSE(mustGiveWay({kLow, 20, own}, {kHigh, 10, other}));
    }
  }
}

TEST(SessionGuard, AnEstablishedDaemonStaysBesideANewOneWhateverItsUuidAndClock) {
  EXPECT_FALSE(mustGiveWay({kHigh, 20, kEstablishedHeartbeat}, {kLow, 10, 1}));
  EXPECT_TRUE(mustGiveWay({kLow, 10, 1}, {kHigh, 20, kEstablishedHeartbeat}));
}

TEST(SessionGuard, OfTwoEstablishedDaemonsExactlyTheOlderStays) {
  for (const std::uint64_t beats : {kEstablishedHeartbeat, kEstablishedHeartbeat + 1000}) {
    EXPECT_TRUE(mustGiveWay({kLow, 20, kEstablishedHeartbeat}, {kHigh, 10, beats}));
    EXPECT_FALSE(mustGiveWay({kHigh, 10, beats}, {kLow, 20, kEstablishedHeartbeat}));
    EXPECT_TRUE(mustGiveWay({kHigh, 10, kEstablishedHeartbeat}, {kLow, 10, beats}));
    EXPECT_FALSE(mustGiveWay({kLow, 10, beats}, {kHigh, 10, kEstablishedHeartbeat}));
  }
}

TEST(SessionGuard, TheRefusalNamesTheOtherDaemon) {
  const Status refused = nameTaken("theatre", {{kLow, 10, 9}, "ward-3", 4711});
  EXPECT_EQ(refused.code(), StatusCode::unavailable);
  EXPECT_THAT(refused.message(), testing::AllOf(testing::HasSubstr("theatre"), testing::HasSubstr("ward-3"),
                                                testing::HasSubstr("4711"), testing::HasSubstr("--session")));
}

}  // namespace
}  // namespace bleedsim::daemon
