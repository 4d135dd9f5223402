// Trainers that misbehave, and two that command one session: the others are served, the world steps on, and the status tells who
// did what.
#include <csignal>
#include <gmock/gmock.h>
#include <limits>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kAccepted = bleed_v1_REPLY_ACCEPTED;

bleed_v1_RequestBody namedWound(const char* name, double x) {
  return Probe::body(bleed_v1_REQUEST_WOUND_ADD, [&](bleed_v1_RequestBody& body) {
    bleed_v1_Wound& added = body._u.wound_add;
    std::snprintf(added.name, sizeof added.name, "%s", name);
    added.position = {x, 0.015, 0.0};
    added.normal = {0.0, 0.0, 1.0};
    added.radius_m = 0.003;
    added.flow_ml_per_s = 1.0;
  });
}

/// The world has made a step since.
void expectSteps(Probe& probe) {
  const std::uint64_t step = probe.status().step;
  EXPECT_GT(probe.status([step](const StatusHead& status) { return status.step > step; }).step, step);
}

TEST_F(ServiceTest, AFloodOfRequestsKeepsNobodyWaiting) {
  test::ChildProcess daemon{daemonCommand("flood")};
  Probe polite{domain(), "flood"};
  Probe flooder{domain(), "flood"};
  ASSERT_EQ(flooder.ask(Probe::pace(1.0)).code, kAccepted);
  std::uint64_t sent = 0;
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 1000; ++i) {
      sent += flooder.send(i % 2 == 0 ? Probe::pace(1.0 + 1e-6 * i) : Probe::body(bleed_v1_REQUEST_PING)) ? 1 : 0;
    }
    const bleed_v1_Reply reply = polite.ask(bleed_v1_REQUEST_RESUME);
    ASSERT_EQ(reply.code, kAccepted) << reply.reason;
  }
  expectSteps(polite);
  EXPECT_GT(sent, 1000U);
  const StatusHead status = polite.status([&](const StatusHead& head) {
    return head.activityOf(flooder.client()).requests > 1000 && head.activityOf(polite.client()).requests >= 10;
  });
  EXPECT_EQ(status.activityOf(polite.client()).busy, 0U);
  EXPECT_EQ(status.activityOf(polite.client()).refused, 0U);
  polite.status([&](const StatusHead& head) {
    return head.counter("requests_busy") == head.activityOf(flooder.client()).busy;  // once the flood is over
  });
}

TEST_F(ServiceTest, ABurstOfInstrumentsKeepsNobodyWaiting) {
  test::ChildProcess daemon{daemonCommand("burst")};
  Probe polite{domain(), "burst"};
  Probe flooder{domain(), "burst"};
  flooder.matchInstruments();
  polite.matchInstruments();
  // Some 150 bytes each: 1 MB in one go, of more tools than a session has. What the middleware has no room for is lost at once,
  // and of the rest a daemon that gets no time for a while sees the newest 1024.
  std::uint64_t sent = 0;
  for (std::uint64_t i = 1; i <= 7000; ++i) {
    sent += flooder.trySendInstrument(i, [i](bleed_v1_Instrument& sample) { sample.tool = static_cast<std::uint32_t>(i % 100); })
                ? 1
                : 0;
  }
  EXPECT_GT(sent, 1000U);
  EXPECT_EQ(polite.ask(bleed_v1_REQUEST_RESUME).code, kAccepted);
  polite.sendInstrument(1);
  polite.journal([&polite](const bleed_v1_Journal& entry) {
    return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT && transport::toUuid(entry.body._u.instrument.client) == polite.client();
  });
  expectSteps(polite);
  const StatusHead status =
      polite.status([&](const StatusHead& head) { return head.activityOf(flooder.client()).instrument_samples >= 1000; });
  EXPECT_GT(status.activityOf(flooder.client()).instruments_rejected, 0U);
  EXPECT_EQ(status.activityOf(polite.client()).instruments_rejected, 0U);
  EXPECT_EQ(polite.ask(bleed_v1_REQUEST_PAUSE).code, kAccepted);
}

TEST_F(ServiceTest, AStoppedRecorderHoldsNobodyUp) {
  test::ChildProcess daemon{daemonCommand("stopped")};
  Probe probe{domain(), "stopped"};
  probe.matchInstruments();
  test::ChildProcess recorder{{BLEEDSIM_SUBSCRIBER, std::to_string(domain()), "stopped"}};
  ASSERT_TRUE(recorder.waitForOutput("reading"));
  recorder.signal(SIGSTOP);
  // Each sample becomes an entry of the journal, which the recorder reads reliably; far more than its socket holds.
  for (std::uint64_t seq = 1; seq <= 5000; ++seq) {
    probe.trySendInstrument(seq);
    if (seq % 1000 == 0) { ASSERT_EQ(probe.ask(bleed_v1_REQUEST_RESUME).code, kAccepted); }
  }
  probe.sendInstrument(6000);
  probe.journal([](const bleed_v1_Journal& entry) {
    return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT && entry.body._u.instrument.seq == 6000;
  });
  expectSteps(probe);
  EXPECT_EQ(probe.status().counter("write_failures"), 0U);
  recorder.signal(SIGCONT);
}

TEST_F(ServiceTest, NonsenseIsRefusedAndCountedByItsSender) {
  test::ChildProcess daemon{daemonCommand("nonsense")};
  Probe polite{domain(), "nonsense"};
  Probe fool{domain(), "nonsense"};
  fool.matchInstruments();
  ASSERT_NE(fool.ask(99U).code, kAccepted);
  ASSERT_NE(fool.ask(Probe::pace(std::numeric_limits<double>::quiet_NaN())).code, kAccepted);
  ASSERT_NE(fool.ask(namedWound("x", 1e300)).code, kAccepted);
  fool.sendInstrument(1, [](bleed_v1_Instrument& sample) { sample.force.x = std::numeric_limits<double>::infinity(); });
  fool.sendInstrument(2, [](bleed_v1_Instrument& sample) { sample.tip_radius_m = -1.0; });
  const StatusHead status =
      polite.status([&](const StatusHead& head) { return head.activityOf(fool.client()).instruments_rejected >= 2; });
  EXPECT_EQ(status.activityOf(fool.client()).refused, 3U);
  EXPECT_EQ(status.activityOf(fool.client()).requests, 3U);
  expectSteps(polite);
}

TEST_F(ServiceTest, StaleClocksDoNoHarm) {
  test::ChildProcess daemon{daemonCommand("clocks")};
  Probe probe{domain(), "clocks"};
  probe.matchInstruments();
  std::uint64_t seq = 0;
  for (const std::int64_t stamp :
       {std::int64_t{0}, std::int64_t{-5}, std::numeric_limits<std::int64_t>::max(), std::int64_t{1}}) {
    const bleed_v1_Reply pong = probe.ask(bleed_v1_REQUEST_PING, [stamp](auto& body) { body._u.ping.client_stamp_ns = stamp; });
    EXPECT_EQ(pong.code, kAccepted);
    EXPECT_EQ(pong.client_stamp_ns, stamp);
    probe.sendInstrument(++seq, [stamp](bleed_v1_Instrument& sample) { sample.stamp_ns = stamp; });
    probe.journal([seq](const bleed_v1_Journal& entry) {
      return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT && entry.body._u.instrument.seq == seq;
    });
  }
}

TEST_F(ServiceTest, AClientThatStartsAgainUnderItsOldUuidIsServed) {
  test::ChildProcess daemon{daemonCommand("again-uuid")};
  Probe first{domain(), "again-uuid"};
  first.matchInstruments();
  ASSERT_EQ(first.ask(namedWound("one", 0.015)).object_id, 2U);
  first.sendInstrument(1000);
  first.journal([](const bleed_v1_Journal& entry) {
    return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT && entry.body._u.instrument.seq == 1000;
  });
  Probe second{domain(), "again-uuid"};
  second.impersonate(first);
  second.matchInstruments();
  EXPECT_EQ(second.ask(namedWound("two", -0.015)).object_id, 3U) << "the same number of another run is another request";
  second.sendInstrument(1);
  second.journal([](const bleed_v1_Journal& entry) {
    return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT && entry.body._u.instrument.seq == 1;
  });
}

TEST_F(ServiceTest, HundredsOfSubscribersThatNeverReadStopNobody) {
  test::ChildProcess daemon{daemonCommand("crowd")};
  Probe probe{domain(), "crowd"};
  transport::ParticipantOptions options;
  options.domain = domain();
  std::vector<transport::Reader<bleed_v1_Frame>> crowd;
  const auto participant = transport::Participant::create(options);
  ASSERT_TRUE(participant.ok()) << participant.status().message();
  for (int i = 0; i < 300; ++i) {
    const Reading reading = i % 2 == 0 ? Reading::live : Reading::recorder;
    auto reader =
        transport::Reader<bleed_v1_Frame>::create(*participant, "crowd", transport::readerQos(transport::Topic::frame, reading));
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    crowd.push_back(std::move(*reader));
  }
  auto wait_set = transport::WaitSet::create(*participant);
  ASSERT_TRUE(wait_set.ok());
  for (auto& reader : crowd) ASSERT_TRUE(wait_set->attachMatches(reader, 0).ok());
  for (auto& reader : crowd) {
    while (reader.matchedCount() == 0) ASSERT_TRUE(wait_set->wait(test::kPatience).ok());
  }
  const FrameHead now = probe.frame();
  EXPECT_GE(probe.frame([&](const FrameHead& frame) { return frame.seq > now.seq + 30; }).step, now.step);
  EXPECT_EQ(probe.ask(bleed_v1_REQUEST_RESUME).code, kAccepted);
  expectSteps(probe);
}

TEST_F(ServiceTest, ALeaseKeepsTheOthersOutUntilItsHolderIsGone) {
  test::ChildProcess daemon{daemonCommand("lease")};
  Probe other{domain(), "lease"};
  other.matchInstruments();
  auto holder = std::make_unique<Probe>(domain(), "lease");
  const auto acquire = Probe::body(bleed_v1_REQUEST_ACQUIRE, [](auto& body) { body._u.acquire.seconds = 300.0; });
  ASSERT_EQ(holder->ask(acquire).code, kAccepted);
  const auto held = [&](const StatusHead& status) { return status.lease_client == holder->client(); };
  EXPECT_EQ(other.status(held).lease_client, holder->client());
  const bleed_v1_Reply refused = other.ask(bleed_v1_REQUEST_PAUSE);
  EXPECT_EQ(refused.code, static_cast<std::uint32_t>(bleed_v1_REPLY_LEASED));
  EXPECT_THAT(refused.reason, HasSubstr("has the lease for up to"));
  EXPECT_EQ(other.ask(bleed_v1_REQUEST_PING).code, kAccepted);
  other.sendInstrument(1);
  other.status([&](const StatusHead& status) { return status.activityOf(other.client()).instruments_rejected == 1; });
  EXPECT_EQ(holder->ask(bleed_v1_REQUEST_RESUME).code, kAccepted);
  holder.reset();
  other.status([](const StatusHead& status) { return status.lease_client == transport::Uuid{}; });
  EXPECT_EQ(other.ask(bleed_v1_REQUEST_RESUME).code, kAccepted);
}

TEST_F(ServiceTest, TwoTrainersShareWoundsByName) {
  test::ChildProcess daemon{daemonCommand("names")};
  Probe one{domain(), "names"};
  Probe two{domain(), "names"};
  ASSERT_EQ(one.ask(namedWound("liver", 0.015)).object_id, 2U);
  const bleed_v1_Reply taken = two.ask(namedWound("liver", -0.015));
  EXPECT_NE(taken.code, kAccepted);
  EXPECT_THAT(taken.reason, HasSubstr("'liver' is already that of wound 2"));
  const auto flow = [](const char* name, double q) {
    return Probe::body(bleed_v1_REQUEST_WOUND_UPDATE, [&](bleed_v1_RequestBody& body) {
      bleed_v1_WoundUpdate& update = body._u.wound_update;
      std::snprintf(update.wound_name, sizeof update.wound_name, "%s", name);
      update.fields = bleed_v1_WOUND_FIELD_DRIVE;
      update.wound.flow_ml_per_s = q;
    });
  };
  EXPECT_EQ(two.ask(flow("liver", 0.5)).object_id, 2U);
  EXPECT_EQ(one.ask(flow("cut", 0.25)).object_id, 1U) << "the scene's own wound";
  const auto remove = Probe::body(bleed_v1_REQUEST_WOUND_REMOVE, [](bleed_v1_RequestBody& body) {
    std::snprintf(body._u.wound_remove.wound_name, sizeof body._u.wound_remove.wound_name, "liver");
  });
  EXPECT_EQ(two.ask(remove).code, kAccepted);
  const bleed_v1_Reply gone = one.ask(flow("liver", 1.0));
  EXPECT_EQ(gone.code, static_cast<std::uint32_t>(bleed_v1_REPLY_NOT_FOUND));
  EXPECT_STREQ(gone.reason, "there is no wound named 'liver'");
}

}  // namespace
}  // namespace bleedsim::service_test
