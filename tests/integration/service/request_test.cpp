// Requests: answered once, refused with a reason, and without a trace when refused.
#include <cstdio>
#include <gmock/gmock.h>
#include <limits>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bleed_v1_RequestBody wound(double x) {
  return Probe::body(bleed_v1_REQUEST_WOUND_ADD, [x](bleed_v1_RequestBody& body) {
    bleed_v1_Wound& added = body._u.wound_add;
    added.position = {x, 0.015, 0.0};
    added.normal = {0.0, 0.0, 1.0};
    added.radius_m = 0.003;
    added.flow_ml_per_s = 1.0;
  });
}

bleed_v1_RequestBody force(double newtons) {
  return Probe::body(bleed_v1_REQUEST_FORCE, [newtons](bleed_v1_RequestBody& body) {
    body._u.force = {{0.0, 0.0, 0.003}, 0.01, {newtons, 0.0, 0.0}, 0.1};
  });
}

TEST_F(ServiceTest, ARequestSentAgainGetsTheFirstReply) {
  test::ChildProcess daemon{daemonCommand("again")};
  Probe probe{domain(), "again"};
  const bleed_v1_Reply first = probe.askAs(1, wound(0.015));
  ASSERT_EQ(first.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << first.reason;
  EXPECT_EQ(first.object_id, 2U);
  probe.frame([&](const FrameHead& frame) { return frame.step > first.applied_step + 20; });
  const bleed_v1_Reply again = probe.askAs(1, wound(0.015));
  EXPECT_EQ(again.applied_step, first.applied_step);
  EXPECT_EQ(again.object_id, first.object_id);
  EXPECT_EQ(again.reply_stamp_ns, first.reply_stamp_ns);
  const std::uint64_t step = probe.frame().step;
  EXPECT_EQ(probe.stats([&](const StatsHead& stats) { return stats.step > step; }).wounds, 2U) << "it was carried out once";
}

TEST_F(ServiceTest, AnUnknownRequestIsAnsweredUnsupported) {
  test::ChildProcess daemon{daemonCommand("unknown")};
  Probe probe{domain(), "unknown"};
  const bleed_v1_Reply reply = probe.ask(99U);
  EXPECT_EQ(reply.code, static_cast<std::uint32_t>(bleed_v1_REPLY_UNSUPPORTED));
  EXPECT_THAT(reply.reason, HasSubstr("request 99"));
}

TEST_F(ServiceTest, RefusedRequestsLeaveTheStateAsItWas) {
  test::ChildProcess daemon{daemonCommand("bad")};
  Probe probe{domain(), "bad"};
  ASSERT_EQ(probe.ask(bleed_v1_REQUEST_PAUSE).code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED));
  const std::uint64_t undisturbed = probe.hashAfterReset(300, {});
  std::string unknown_field = "name: 'x' nonsense { }";
  std::string not_finite = smallScene();
  not_finite.replace(not_finite.find("flow_ml_per_s: 1.5"), 18, "flow_ml_per_s: nan");
  std::string broken_wounds = smallScene() +
                              "wounds { disc { radius_m: 0.003 } flow_ml_per_s: 500 }\n"
                              "wounds { position_m { x: 0.029 } disc { radius_m: 0.003 } flow_ml_per_s: 1 }\n";
  const auto load = [](std::string& text) {
    return Probe::body(bleed_v1_REQUEST_LOAD_SCENE, [&text](auto& body) { body._u.load_scene.text = text.data(); });
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<std::function<void(bleed_v1_Instrument&)>> bad_instruments{
      [](auto& tool) { tool.position.x = kNaN; },         [](auto& tool) { tool.position.z = kInfinity; },
      [](auto& tool) { tool.position.y = -1e9; },         [](auto& tool) { tool.force.x = kNaN; },
      [](auto& tool) { tool.force.y = -kInfinity; },      [](auto& tool) { tool.force.z = 1e9; },
      [](auto& tool) { tool.tip_radius_m = kNaN; },       [](auto& tool) { tool.tip_radius_m = kInfinity; },
      [](auto& tool) { tool.tip_radius_m = 1e9; },        [](auto& tool) { tool.tip_radius_m = 0.0; },
      [](auto& tool) { tool.tip_radius_m = -0.01; },      [](auto& tool) { tool.orientation.w = kNaN; },
      [](auto& tool) { tool.orientation.x = kInfinity; }, [](auto& tool) { tool.name[0] = '\n'; },
      [](auto& tool) { tool.name[0] = '\xff'; }};
  std::vector<bleed_v1_RequestBody> bad{
      load(unknown_field),
      load(not_finite),
      load(broken_wounds),
      wound(kNaN),
      wound(std::numeric_limits<double>::infinity()),
      wound(1e9),
      wound(5.0),
      force(kNaN),
      force(1e9),
      Probe::body(bleed_v1_REQUEST_FORCE,
                  [](auto& body) {
                    body._u.force = {{5.0, 0.0, 0.0}, 0.01, {0.0, 0.0, 1.0}, 1.0};
                  }),
      Probe::body(bleed_v1_REQUEST_WOUND_REMOVE, [](auto& body) { body._u.wound_remove.wound_id = 777; }),
      Probe::body(bleed_v1_REQUEST_WOUND_UPDATE, [](auto& body) { body._u.wound_update.wound_id = 1; }),
      Probe::pace(-1.0),
      Probe::body(bleed_v1_REQUEST_OUTPUT, [](auto& body) { body._u.output.rate_hz = kNaN; }),
      Probe::body(1234)};
  const std::uint64_t after = probe.hashAfterReset(300, [&] {
    for (const bleed_v1_RequestBody& body : bad) {
      const bleed_v1_Reply reply = probe.ask(body);
      EXPECT_NE(reply.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << "request " << body._d;
      EXPECT_STRNE(reply.reason, "");
    }
    probe.matchInstruments();
    std::uint64_t seq = 0;
    for (const auto& spoil : bad_instruments) probe.sendInstrument(++seq, spoil);
    probe.sendInstrument(++seq, [](auto& tool) { tool.position.x = 5.0; });
    probe.status([&](const StatusHead& status) {
      return status.counter("instrument_samples") == seq && status.counter("instruments_refused") == 1;
    });
    const StatusHead status = probe.status();
    EXPECT_EQ(status.counter("instruments_malformed"), bad_instruments.size());
  });
  EXPECT_EQ(after, undisturbed);
  const std::uint64_t pushed = probe.hashAfterReset(300, [&] { probe.ask(wound(0.015)); });
  EXPECT_NE(pushed, undisturbed) << "an accepted one does change it";
}

TEST_F(ServiceTest, LoadsAndRefusesScenes) {
  test::ChildProcess daemon{daemonCommand("load")};
  Probe probe{domain(), "load"};
  const std::uint32_t epoch = probe.frame().epoch;
  std::string broken = "name: 'x' nonsense { }";
  const bleed_v1_Reply refused =
      probe.ask(bleed_v1_REQUEST_LOAD_SCENE, [&](auto& body) { body._u.load_scene.text = broken.data(); });
  EXPECT_EQ(refused.code, static_cast<std::uint32_t>(bleed_v1_REPLY_SCENE));
  EXPECT_EQ(refused.epoch, epoch);
  std::string good = smallScene(0.2);
  const bleed_v1_Reply loaded =
      probe.ask(bleed_v1_REQUEST_LOAD_SCENE, [&](auto& body) { body._u.load_scene.text = good.data(); });
  EXPECT_EQ(loaded.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << loaded.reason;
  EXPECT_EQ(loaded.applied_step, 0U);
  EXPECT_EQ(loaded.epoch, epoch + 1);
  probe.frame([&](const FrameHead& frame) { return frame.epoch == epoch + 1 && frame.step > 100; });
}

TEST_F(ServiceTest, ThePingComesBackWithItsStamp) {
  test::ChildProcess daemon{daemonCommand("ping")};
  Probe probe{domain(), "ping"};
  const std::int64_t before = transport::monotonicNow();
  const bleed_v1_Reply reply = probe.ask(bleed_v1_REQUEST_PING, [](auto& body) { body._u.ping.client_stamp_ns = 4711; });
  EXPECT_EQ(reply.client_stamp_ns, 4711);
  EXPECT_GE(reply.receive_stamp_ns, before);
  EXPECT_LE(reply.reply_stamp_ns, transport::monotonicNow());
  EXPECT_GE(reply.reply_stamp_ns, reply.receive_stamp_ns);
}

}  // namespace
}  // namespace bleedsim::service_test
