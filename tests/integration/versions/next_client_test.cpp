// A client of the next minor version and the present daemon; compiled against the next contract.
#include <cstring>
#include <vector>

#include "tests/integration/versions/version_fixture.h"

namespace bleedsim::versions_test {
namespace {

using service_test::Probe;

class NextClientPresentDaemon : public VersionFixture {};

/// What the present daemon did not send.
template <class T>
void expectNothingGrown(const T& sample) {
  EXPECT_EQ(sample.next_number, 0U);
  EXPECT_STREQ(sample.next_text, "");
  EXPECT_EQ(sample.next_values._length, 0U);
}

template <class T>
void grow(T& sample, std::vector<double>& values) {
  sample.next_number = 7;
  std::strcpy(sample.next_text, "later");
  sample.next_values = {static_cast<std::uint32_t>(values.size()), static_cast<std::uint32_t>(values.size()), values.data(),
                        false};
}

/// Waits for a sample of the topic and lets `check` look at it.
template <class T>
void hear(const transport::Participant& participant, const std::string& session, const std::function<void(const T&)>& check) {
  auto reader = transport::Reader<T>::create(participant, session);
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  auto wait_set = transport::WaitSet::create(participant);
  ASSERT_TRUE(wait_set.ok() && wait_set->attach(*reader, 0).ok());
  bool heard = false;
  while (!heard) {
    ASSERT_TRUE(wait_set->wait(test::kPatience).ok());
    const auto look = [&](const transport::Sample<T>& sample) {
      if (sample.data == nullptr) return;
      heard = true;
      check(*sample.data);
    };
    ASSERT_TRUE(reader->take(look, 1).ok());
  }
}

TEST_F(NextClientPresentDaemon, HearEachOtherOnEveryTopic) { hearEveryTopic("present"); }

TEST_F(NextClientPresentDaemon, TheLibraryCommands) { commandThroughTheLibrary("present", bleed_v1_PROTOCOL_MINOR - 1); }

TEST_F(NextClientPresentDaemon, AnUnknownRequestIsAnsweredUnsupported) {
  askForTheUnknown("present", bleed_v1_REQUEST_NEXT, [](bleed_v1_RequestBody& body) {
    body._u.next_news.number = 12;
    std::strcpy(body._u.next_news.text, "news");
  });
}

TEST_F(NextClientPresentDaemon, AppendedMembersAreZero) {
  test::ChildProcess daemon{daemonCommand("present")};
  const auto participant = transport::Participant::create({.domain = domain()});
  ASSERT_TRUE(participant.ok()) << participant.status().message();
  hear<bleed_v1_Status>(*participant, "present", [](const auto& status) {
    expectNothingGrown(status);
    ASSERT_GT(status.counters._length, 0U);
    for (std::uint32_t i = 0; i < status.counters._length; ++i) expectNothingGrown(status.counters._buffer[i]);
  });
  hear<bleed_v1_Scene>(*participant, "present", [](const auto& scene) { expectNothingGrown(scene); });
  hear<bleed_v1_FrameStats>(*participant, "present", [](const auto& stats) {
    expectNothingGrown(stats);
    ASSERT_EQ(stats.wounds._length, 1U);
    expectNothingGrown(stats.wounds._buffer[0]);
    ASSERT_GT(stats.stage_costs._length, 0U);
    for (std::uint32_t i = 0; i < stats.stage_costs._length; ++i) expectNothingGrown(stats.stage_costs._buffer[i]);
  });
  Probe probe{domain(), "present"};
  expectNothingGrown(probe.ask(bleed_v1_REQUEST_PING));
}

TEST_F(NextClientPresentDaemon, AppendedMembersOfRequestsAndInstrumentsAreSkipped) {
  test::ChildProcess daemon{daemonCommand("present")};
  Probe probe{domain(), "present"};
  std::vector<double> values{1.0, 2.0, 3.0};
  const bleed_v1_Reply added = probe.ask(bleed_v1_REQUEST_WOUND_ADD, [&](bleed_v1_RequestBody& body) {
    bleed_v1_Wound& wound = body._u.wound_add;
    wound.position = {0.015, 0.015, 0.0};
    wound.normal.z = 1.0;
    wound.radius_m = 0.003;
    wound.flow_ml_per_s = 1.25;
    grow(wound, values);
  });
  EXPECT_EQ(added.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << added.reason;
  const bleed_v1_Reply changed = probe.ask(bleed_v1_REQUEST_WOUND_UPDATE, [&](bleed_v1_RequestBody& body) {
    bleed_v1_WoundUpdate& update = body._u.wound_update;
    update.wound_id = 2;
    update.fields = bleed_v1_WOUND_FIELD_DRIVE;
    update.wound.flow_ml_per_s = 0.75;
    grow(update.wound, values);
    grow(update, values);
  });
  EXPECT_EQ(changed.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << changed.reason;
  probe.matchInstruments();
  probe.sendInstrument(1, [&](bleed_v1_Instrument& tool) { grow(tool, values); });

  // The journal tells what the daemon understood: the present members, and nothing of the later ones.
  probe.journal([](const bleed_v1_Journal& entry) {
    if (entry.body._d != bleed_v1_JOURNAL_REQUEST || entry.body._u.request.request.seq != 2) return false;
    const bleed_v1_WoundUpdate& update = entry.body._u.request.request.body._u.wound_update;
    EXPECT_EQ(update.wound_id, 2U);
    EXPECT_EQ(update.wound.flow_ml_per_s, 0.75);
    expectNothingGrown(update);
    expectNothingGrown(update.wound);
    return true;
  });
  probe.journal([](const bleed_v1_Journal& entry) {
    if (entry.body._d != bleed_v1_JOURNAL_INSTRUMENT) return false;
    EXPECT_EQ(entry.body._u.instrument.seq, 1U);
    EXPECT_EQ(entry.body._u.instrument.tip_radius_m, 0.01);
    expectNothingGrown(entry.body._u.instrument);
    return true;
  });
}

}  // namespace
}  // namespace bleedsim::versions_test
