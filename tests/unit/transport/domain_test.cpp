#include "service/transport/domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/transport/interfaces.h"
#include "service/transport/participant.h"

namespace bleedsim::transport {
namespace {

using testing::HasSubstr;

TEST(Interfaces, AMissingOneIsRefusedWithTheExistingNames) {
  const std::vector<NetworkInterface> existing{{"lo", true, true}, {"eth7", false, true}, {"eth8", false, false}};
  EXPECT_EQ(findInterface("eth7", existing)->name, "eth7");
  const auto missing = findInterface("wlan3", existing);
  EXPECT_EQ(missing.status().code(), StatusCode::not_found);
  EXPECT_THAT(missing.status().message(), HasSubstr("wlan3"));
  EXPECT_THAT(missing.status().message(), HasSubstr("lo, eth7, eth8"));
  EXPECT_EQ(findInterface("eth8", existing).status().code(), StatusCode::unavailable);
}

TEST(Participant, RefusesBadOptionsWithAnExplanation) {
  const auto domain = Participant::create({.domain = 231});
  EXPECT_EQ(domain.status().code(), StatusCode::invalid_argument);
  EXPECT_THAT(domain.status().message(), HasSubstr("231"));
  const auto interface = Participant::create({.domain = 60, .interface = "nosuch0"});
  EXPECT_EQ(interface.status().code(), StatusCode::not_found);
  EXPECT_THAT(interface.status().message(), HasSubstr("lo"));
  const auto tag = Participant::create({.domain = 60, .tag = "</Tag>"});
  EXPECT_EQ(tag.status().code(), StatusCode::invalid_argument);
}

TEST(Participant, SharesTheDomainOfTheProcess) {
  const ParticipantOptions options{.domain = 61, .tag = "share"};
  auto first = Participant::create(options);
  ASSERT_TRUE(first.ok()) << first.status().message();
  const auto second = Participant::create(options);
  ASSERT_TRUE(second.ok()) << second.status().message();
  EXPECT_NE(first->handle(), second->handle());
  const auto other = Participant::create({.domain = 61, .tag = "other"});
  EXPECT_EQ(other.status().code(), StatusCode::wrong_state);
}

TEST(Participant, FreesTheDomainWithItsLastShare) {
  { ASSERT_TRUE(Participant::create({.domain = 62, .tag = "a"}).ok()); }
  const auto again = Participant::create({.domain = 62, .tag = "b"});
  EXPECT_TRUE(again.ok()) << again.status().message();
}

}  // namespace
}  // namespace bleedsim::transport
