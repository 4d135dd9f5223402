#include "clients/lib/pinned_daemon.h"

#include <gtest/gtest.h>

namespace bleedsim::client {
namespace {

constexpr Uuid kOne{1};
constexpr Uuid kTwo{2};
constexpr Uuid kThree{3};

TEST(PinnedDaemon, OwnsTheKnownOneWhoeverSpeaksFirst) {
  PinnedDaemon daemon{KnownDaemon{kOne, 100}};
  EXPECT_FALSE(daemon.owns(kTwo));
  EXPECT_TRUE(daemon.owns(kOne));
  EXPECT_FALSE(daemon.owns(kTwo));
}

TEST(PinnedDaemon, WithoutAKnownOneTheFirstToSpeakStays) {
  PinnedDaemon daemon{std::nullopt};
  EXPECT_TRUE(daemon.owns(kTwo));
  EXPECT_TRUE(daemon.owns(kTwo));
  EXPECT_FALSE(daemon.owns(kOne));
}

TEST(PinnedDaemon, OnlyOneThatStartedLaterReplacesIt) {
  PinnedDaemon daemon{KnownDaemon{kTwo, 200}};
  EXPECT_FALSE(daemon.replaced());
  daemon.started(kOne, 100);  // a killed predecessor, still in the readers
  daemon.started(kThree, 200);
  EXPECT_FALSE(daemon.replaced());
  daemon.started(kThree, 201);
  EXPECT_TRUE(daemon.replaced());
  daemon.started(kOne, 100);
  daemon.started(kTwo, 200);
  EXPECT_TRUE(daemon.replaced()) << "a replacement stays one";
}

TEST(PinnedDaemon, ComparesAsSoonAsItsOwnStartIsKnown) {
  PinnedDaemon daemon{std::nullopt};
  EXPECT_TRUE(daemon.owns(kOne));
  daemon.started(kTwo, 300);
  EXPECT_FALSE(daemon.replaced());
  daemon.started(kOne, 200);
  EXPECT_TRUE(daemon.replaced());
}

}  // namespace
}  // namespace bleedsim::client
