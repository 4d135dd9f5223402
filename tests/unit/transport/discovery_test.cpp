// What DDS's discovery tells of a domain.
#include "service/transport/discovery.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "service/transport/reader.h"
#include "service/transport/writer.h"

namespace bleedsim::transport {
namespace {

using testing::ElementsAre;

constexpr std::uint32_t kDomain = 63;

/// Alone in the domain, also when other tests run beside.
Result<Participant> joinAlone() { return Participant::create({.domain = kDomain, .tag = fmt::format("o{}", getpid())}); }

TEST(DomainObserver, SeesParticipantsWritersAndReadersOfThisProcess) {
  const auto participant = joinAlone();
  ASSERT_TRUE(participant) << participant.status().message();
  const auto observer = DomainObserver::create(*participant);
  ASSERT_TRUE(observer) << observer.status().message();
  auto writer = Writer<bleed_v1_Status>::create(*participant, "theatre");
  const auto reader = Reader<bleed_v1_Frame>::create(*participant, "theatre", readerQos(Topic::frame, Reading::live));
  ASSERT_TRUE(writer && reader);

  const DomainView view = observer->view();
  ASSERT_EQ(view.members.size(), 1U);
  EXPECT_EQ(view.members[0].vendor, kOwnVendor);
  EXPECT_EQ(view.members[0].pid, getpid());
  EXPECT_FALSE(view.members[0].host.empty());
  EXPECT_FALSE(view.members[0].process.empty());

  ASSERT_EQ(view.endpoints.size(), 2U);
  const auto& written = view.endpoints[0];
  EXPECT_TRUE(written.writer);
  EXPECT_TRUE(written.reliable);
  EXPECT_EQ(written.topic, "bleed/v1/status");
  EXPECT_THAT(written.partitions, ElementsAre("theatre"));
  EXPECT_EQ(written.member, view.members[0].guid);
  const auto& read = view.endpoints[1];
  EXPECT_FALSE(read.writer);
  EXPECT_FALSE(read.reliable);
  EXPECT_EQ(read.topic, "bleed/v1/frame");
}

TEST(DomainObserver, ForgetsWhatIsGone) {
  const auto participant = joinAlone();
  ASSERT_TRUE(participant);
  const auto observer = DomainObserver::create(*participant);
  ASSERT_TRUE(observer);
  {
    const auto writer = Writer<bleed_v1_Status>::create(*participant, "theatre");
    ASSERT_TRUE(writer);
    EXPECT_EQ(observer->view().endpoints.size(), 1U);
  }
  EXPECT_EQ(observer->view().endpoints.size(), 0U);
  EXPECT_EQ(observer->view().members.size(), 1U);
}

TEST(VendorName, IsThatOfTheNumber) {
  EXPECT_EQ(vendorName(kOwnVendor), "Cyclone DDS");
  EXPECT_EQ(vendorName(0x010f), "Fast DDS");
  EXPECT_EQ(vendorName(0x0beb), "vendor 0x0beb");
  EXPECT_EQ(vendorOf({0x01, 0x0f, 7}), 0x010f);
}

}  // namespace
}  // namespace bleedsim::transport
