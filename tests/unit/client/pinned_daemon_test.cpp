#include "clients/lib/pinned_daemon.h"

#include <gtest/gtest.h>

namespace bleedsim::client {
namespace {

constexpr Uuid kOne{1};
constexpr Uuid kTwo{2};

TEST(PinnedDaemon, OwnsTheKnownOneWhoeverSpeaksFirst) {
  PinnedDaemon daemon{kOne};
  EXPECT_FALSE(daemon.owns(kTwo));
  EXPECT_TRUE(daemon.strangerHeard());
  EXPECT_TRUE(daemon.owns(kOne));
  EXPECT_FALSE(daemon.owns(kTwo));
}

TEST(PinnedDaemon, WithoutAKnownOneTheFirstToSpeakStays) {
  PinnedDaemon daemon{std::nullopt};
  EXPECT_TRUE(daemon.owns(kTwo));
  EXPECT_TRUE(daemon.owns(kTwo));
  EXPECT_FALSE(daemon.strangerHeard());
  EXPECT_FALSE(daemon.owns(kOne));
  EXPECT_TRUE(daemon.strangerHeard());
}

}  // namespace
}  // namespace bleedsim::client
