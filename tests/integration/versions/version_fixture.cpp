#include "tests/integration/versions/version_fixture.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "bleedsim/client.h"

namespace bleedsim::versions_test {
namespace {

using service_test::FrameHead;
using service_test::Probe;
using service_test::SceneHead;
using service_test::StatsHead;
using service_test::StatusHead;
using testing::HasSubstr;

constexpr std::uint32_t kAccepted = bleed_v1_REPLY_ACCEPTED;

client::Reply answerOf(std::future<client::Reply> coming) {
  const client::Reply reply = coming.get();
  EXPECT_TRUE(reply.accepted()) << client::toString(reply.code) << ": " << reply.reason;
  return reply;
}

}  // namespace

void VersionFixture::hearEveryTopic(const std::string& session) {
  test::ChildProcess daemon{daemonCommand(session)};
  Probe probe{domain(), session};
  const StatusHead status = probe.status([](const StatusHead& head) { return head.state == bleed_v1_STATE_RUNNING; });
  EXPECT_EQ(status.name, session);
  EXPECT_EQ(status.pid, daemon.pid());
  const SceneHead scene = probe.scene();
  EXPECT_EQ(scene.name, "small");
  EXPECT_THAT(scene.effects, testing::Contains("viscosity"));
  EXPECT_THAT(scene.known_effects, testing::Contains("surface_tension"));
  EXPECT_THAT(scene.loaded_text, HasSubstr("small"));

  const FrameHead frame = probe.frame([](const FrameHead& head) { return head.count > 5; });
  EXPECT_EQ(frame.session, status.session);
  const StatsHead stats = probe.stats([&](const StatsHead& head) { return head.seq == frame.seq; });
  EXPECT_EQ(stats.step, frame.step);
  EXPECT_EQ(stats.wounds, 1U);
  EXPECT_NE(stats.state_hash, 0U);

  const bleed_v1_Reply ping = probe.ask(bleed_v1_REQUEST_PING, [](auto& body) { body._u.ping.client_stamp_ns = 77; });
  EXPECT_EQ(ping.code, kAccepted) << ping.reason;
  EXPECT_EQ(ping.client_stamp_ns, 77);
  const bleed_v1_Reply refused = probe.ask(bleed_v1_REQUEST_STEP, [](auto& body) { body._u.step.count = 1; });
  EXPECT_EQ(refused.code, static_cast<std::uint32_t>(bleed_v1_REPLY_STATE));
  EXPECT_THAT(refused.reason, HasSubstr("pause"));

  probe.matchInstruments();
  probe.sendInstrument(1, {});
  const auto pushed = [](const bleed_v1_Journal& entry) { return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT; };
  EXPECT_DOUBLE_EQ(probe.journal(pushed).body._u.instrument.force.z, 1e-4);
  const auto ended = [](const bleed_v1_Journal& entry) { return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT_END; };
  EXPECT_EQ(probe.journal(ended).body._u.instrument_end.reason, static_cast<std::uint32_t>(bleed_v1_INSTRUMENT_END_EXPIRED));
  probe.status([&](const StatusHead& head) {
    const bleed_v1_ClientActivity me = head.activityOf(probe.client());
    return me.requests >= 2 && me.refused == 1 && me.instrument_samples == 1;
  });
}

void VersionFixture::commandThroughTheLibrary(const std::string& session, std::uint32_t minor_of_daemon) {
  test::ChildProcess daemon{daemonCommand(session)};
  Result<client::Client> here = client::Client::create({.domain = domain()});
  ASSERT_TRUE(here.ok()) << here.status().message();
  Result<client::Session> open = here->open(session, {.delivery = client::Delivery::queue}, test::kPatience);
  ASSERT_TRUE(open.ok()) << open.status().message();
  const Result<client::SceneInfo> scene = open->waitScene(test::kPatience);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->protocol_minor, minor_of_daemon);
  EXPECT_NE(minor_of_daemon, std::uint32_t{bleed_v1_PROTOCOL_MINOR}) << "both ends are of one version";

  const Result<client::FramePointer> frame = open->waitFrame(test::kPatience);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_EQ((*frame)->positions().size(), 3U * (*frame)->count());
  EXPECT_TRUE(open->ping(test::kPatience).ok());

  client::WoundSpec wound{.name = "second", .position = {0.015, 0.015, 0.0}, .shape = client::WoundShape::polygon};
  wound.outline = {-0.003, -0.003, 0.003, -0.003, 0.003, 0.003, -0.003, 0.003};
  wound.flow_ml_per_s = 1.0;
  EXPECT_EQ(answerOf(open->addWound(wound)).object_id, 2U);
  answerOf(open->updateWound("second", {.flow_ml_per_s = 0.5}));
  answerOf(open->setEffect("viscosity", true, "viscosity_pa_s: 0.01"));
  answerOf(open->output({.rate_hz = 30.0, .attributes = {{"velocity"}}}));
  answerOf(open->pace({client::PaceMode::factor, 0.5}));
  answerOf(open->acquireLease(std::chrono::seconds{60}));
  EXPECT_EQ(open->waitStatus([](const auto& status) { return status.lease_client.has_value(); }, test::kPatience)->lease_client,
            open->clientId());
  answerOf(open->releaseLease());
  answerOf(open->pause());
  answerOf(open->step(3));
  const std::uint32_t epoch = answerOf(open->reset()).epoch;
  EXPECT_EQ(answerOf(open->loadScene(service_test::smallScene())).epoch, epoch + 1);
  answerOf(open->shutdown());
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
  EXPECT_EQ(open->frameCounters().malformed, 0U);
}

void VersionFixture::askForTheUnknown(const std::string& session, std::uint32_t kind, const Probe::Body& fill) {
  test::ChildProcess daemon{daemonCommand(session)};
  Probe probe{domain(), session};
  const bleed_v1_Reply reply = probe.ask(kind, fill);
  EXPECT_EQ(reply.code, static_cast<std::uint32_t>(bleed_v1_REPLY_UNSUPPORTED)) << reply.reason << daemon.output();
  EXPECT_THAT(reply.reason, HasSubstr(fmt::format("request {} is not known", kind)));
  EXPECT_EQ(probe.ask(bleed_v1_REQUEST_PAUSE).code, kAccepted);
}

}  // namespace bleedsim::versions_test
