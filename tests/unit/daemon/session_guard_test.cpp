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
      EXPECT_TRUE(mustGiveWay(kHigh, own, {kLow, "h", 1, other}));
      EXPECT_FALSE(mustGiveWay(kLow, own, {kHigh, "h", 1, other}));
    }
  }
}

TEST(SessionGuard, AnEstablishedDaemonStaysWhateverItsUuid) {
  EXPECT_FALSE(mustGiveWay(kHigh, kEstablishedHeartbeat, {kLow, "h", 1, 1}));
  EXPECT_TRUE(mustGiveWay(kLow, 1, {kHigh, "h", 1, kEstablishedHeartbeat}));
}

TEST(SessionGuard, TheRefusalNamesTheOtherDaemon) {
  const Status refused = nameTaken("theatre", {kLow, "ward-3", 4711, 9});
  EXPECT_EQ(refused.code(), StatusCode::unavailable);
  EXPECT_THAT(refused.message(), testing::AllOf(testing::HasSubstr("theatre"), testing::HasSubstr("ward-3"),
                                                testing::HasSubstr("4711"), testing::HasSubstr("--session")));
}

}  // namespace
}  // namespace bleedsim::daemon
