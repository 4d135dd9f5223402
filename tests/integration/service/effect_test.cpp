// Effects switched in a running session: the reply, the journal, the scene, and that they act.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <gmock/gmock.h>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr auto kAccepted = static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED);

bleed_v1_RequestBody effect(const std::string& name, bool enabled, const std::string& settings = {}) {
  return Probe::body(bleed_v1_REQUEST_EFFECT, [&](bleed_v1_RequestBody& body) {
    bleed_v1_Effect& set = body._u.effect;
    std::snprintf(set.name, sizeof set.name, "%s", name.c_str());
    std::snprintf(set.settings, sizeof set.settings, "%s", settings.c_str());
    set.enabled = enabled;
  });
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void stepTo(Probe& probe, std::uint32_t count) {
  const bleed_v1_Reply stepped = probe.ask(bleed_v1_REQUEST_STEP, [count](auto& body) { body._u.step.count = count; });
  ASSERT_EQ(stepped.code, kAccepted) << stepped.reason;
}

TEST_F(ServiceTest, AnEffectIsSwitchedWhileTheSessionRuns) {
  test::ChildProcess daemon{daemonCommand("switch")};
  Probe probe{domain(), "switch"};
  const FrameHead before = probe.frame([](const FrameHead& frame) { return frame.step > 50; });
  const bleed_v1_Reply off = probe.ask(effect("viscosity", false));
  ASSERT_EQ(off.code, kAccepted) << off.reason;
  EXPECT_EQ(off.epoch, before.epoch);
  EXPECT_GT(off.applied_step, before.step);
  const SceneHead scene = probe.scene([](const SceneHead& head) { return !has(head.effects, "viscosity"); });
  EXPECT_EQ(scene.epoch, before.epoch);
  EXPECT_THAT(scene.text, Not(HasSubstr("viscosity")));
  EXPECT_THAT(scene.loaded_text, HasSubstr("viscosity"));
  EXPECT_THAT(scene.known_effects, Contains("surface_tension"));
  const bleed_v1_Journal entry = probe.journal([](const bleed_v1_Journal& journal) {
    return journal.body._d == bleed_v1_JOURNAL_REQUEST && journal.body._u.request.request.body._d == bleed_v1_REQUEST_EFFECT;
  });
  EXPECT_EQ(entry.step + 1, off.applied_step);
  EXPECT_STREQ(entry.body._u.request.request.body._u.effect.name, "viscosity");

  const bleed_v1_Reply on = probe.ask(effect("viscosity", true, "viscosity_pa_s: 0.02"));
  ASSERT_EQ(on.code, kAccepted) << on.reason;
  EXPECT_GT(on.applied_step, off.applied_step);
  probe.scene([](const SceneHead& head) { return head.text.find("viscosity_pa_s: 0.02") != std::string::npos; });
  // Time, numbers and wounds go on.
  const FrameHead after = probe.frame([&](const FrameHead& frame) { return frame.step > on.applied_step + 50; });
  EXPECT_EQ(after.epoch, before.epoch);
  EXPECT_GT(after.seq, before.seq);
  EXPECT_GE(after.count, before.count);
  EXPECT_EQ(probe.stats([&](const StatsHead& stats) { return stats.step > on.applied_step; }).wounds, 1U);
}

TEST_F(ServiceTest, ASwitchedEffectActsAndTheSameSwitchGivesTheSameBits) {
  test::ChildProcess daemon{daemonCommand("acts")};
  Probe probe{domain(), "acts"};
  ASSERT_EQ(probe.ask(bleed_v1_REQUEST_PAUSE).code, kAccepted);
  const auto run = [&](const std::vector<bleed_v1_RequestBody>& switches) {
    const bleed_v1_Reply reset = probe.ask(bleed_v1_REQUEST_RESET);
    EXPECT_EQ(reset.code, kAccepted) << reset.reason;
    stepTo(probe, 600);
    probe.stats([&](const StatsHead& stats) { return stats.epoch == reset.epoch && stats.step == 600; });
    for (const bleed_v1_RequestBody& body : switches) {
      const bleed_v1_Reply reply = probe.ask(body);
      EXPECT_EQ(reply.code, kAccepted) << reply.reason;
      EXPECT_EQ(reply.applied_step, 601U);
    }
    stepTo(probe, 400);
    return probe.stats([&](const StatsHead& stats) { return stats.epoch == reset.epoch && stats.step == 1000; });
  };
  const StatsHead plain = run({});
  const StatsHead thick = run({effect("viscosity", true, "viscosity_pa_s: 1")});
  EXPECT_NE(thick.state_hash, plain.state_hash);
  EXPECT_LT(thick.kinetic_energy, plain.kinetic_energy) << "thick blood is slower";
  EXPECT_EQ(run({effect("viscosity", true, "viscosity_pa_s: 1")}).state_hash, thick.state_hash);
  EXPECT_EQ(run({}).state_hash, plain.state_hash) << "a reset brings the loaded scene back";
  EXPECT_EQ(run({effect("viscosity", false), effect("viscosity", true)}).state_hash, plain.state_hash)
      << "off and on again within a step is nothing";
}

TEST_F(ServiceTest, RefusedSwitchesLeaveTheStateAsItWas) {
  test::ChildProcess daemon{daemonCommand("refused")};
  Probe probe{domain(), "refused"};
  ASSERT_EQ(probe.ask(bleed_v1_REQUEST_PAUSE).code, kAccepted);
  const std::uint64_t undisturbed = probe.hashAfterReset(300, {});
  struct Refusal {
    bleed_v1_RequestBody body;
    std::uint32_t code;
    const char* words;
  };
  const std::vector<Refusal> refusals{
      {effect("stickiness", true), bleed_v1_REPLY_NOT_FOUND, "repulsion, adhesion"},
      {effect("", true), bleed_v1_REPLY_INVALID, "effect.name is empty"},
      {effect("viscosity", true, "viscosity_pa_s: -1"), bleed_v1_REPLY_INVALID,
       "effects.viscosity.viscosity_pa_s: value -1 is out of range, allowed 0 to 1000 (Pa s)"},
      {effect("viscosity", true, "viscosity: 1"), bleed_v1_REPLY_INVALID, "did you mean 'viscosity_pa_s'?"},
      {effect("viscosity", true, "viscosity_pa_s: nan"), bleed_v1_REPLY_INVALID, "not finite"},
      {effect("repulsion", true, "power_1: 2"), bleed_v1_REPLY_INVALID,
       "effects.repulsion.power_1: value 2 must be above power_2, 4"},
      {effect("surface_tension", true, std::string(2000, '{')), bleed_v1_REPLY_INVALID, "line 1:1"},
  };
  const std::uint64_t after = probe.hashAfterReset(300, [&] {
    for (const Refusal& refusal : refusals) {
      const bleed_v1_Reply reply = probe.ask(refusal.body);
      EXPECT_EQ(reply.code, refusal.code) << reply.reason;
      EXPECT_THAT(reply.reason, HasSubstr(refusal.words));
    }
    const bleed_v1_Reply off = probe.ask(effect("viscosity", false));
    EXPECT_EQ(off.code, kAccepted) << off.reason;
    const bleed_v1_Reply illegal = probe.ask(effect("platelets", true));
    EXPECT_EQ(illegal.code, static_cast<std::uint32_t>(bleed_v1_REPLY_INVALID));
    EXPECT_THAT(illegal.reason, HasSubstr("effects.platelets: needs viscosity, there is nothing to thicken"));
    EXPECT_EQ(probe.ask(effect("viscosity", true)).code, kAccepted);
  });
  EXPECT_EQ(after, undisturbed);
}

TEST_F(ServiceTest, ALateJoinerSeesTheSwitchedEffects) {
  test::ChildProcess daemon{daemonCommand("joiner")};
  {
    Probe early{domain(), "joiner"};
    ASSERT_EQ(early.ask(bleed_v1_REQUEST_PAUSE).code, kAccepted);
    ASSERT_EQ(early.ask(effect("repulsion", true, "strength: 1.25")).code, kAccepted);
  }
  Probe late{domain(), "joiner"};
  const SceneHead scene = late.scene();
  EXPECT_THAT(scene.effects, Contains("repulsion"));
  EXPECT_THAT(scene.text, HasSubstr("strength: 1.25"));
  EXPECT_THAT(scene.loaded_text, Not(HasSubstr("repulsion")));
}

TEST_F(ServiceTest, CommandsWorkWhileAnEffectIsBeingSwitched) {
  test::ChildProcess daemon{daemonCommand("beside")};
  Probe probe{domain(), "beside"};
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(probe.ask(effect("repulsion", i % 2 == 0)).code, kAccepted);
    const bleed_v1_Reply wound = probe.ask(bleed_v1_REQUEST_WOUND_ADD, [i](bleed_v1_RequestBody& body) {
      bleed_v1_Wound& added = body._u.wound_add;
      added.position = {0.018, -0.018 + 0.012 * i, 0.0};
      added.normal = {0.0, 0.0, 1.0};
      added.radius_m = 0.002;
      added.flow_ml_per_s = 0.2;
    });
    ASSERT_EQ(wound.code, kAccepted) << wound.reason;
    EXPECT_EQ(wound.object_id, static_cast<std::uint32_t>(i + 2)) << "ids go on in the new world";
  }
  EXPECT_EQ(probe.stats([](const StatsHead& stats) { return stats.wounds == 5; }).wounds, 5U);
}

TEST_F(ServiceTest, DecisionsOfAutoAreToldAtLoad) {
  std::string scene = smallScene() + "horizon_s: 0.01\n";
  const std::string more = "surface_tension {} platelets {} auto: ['platelets', 'surface_tension'] ";
  scene.insert(scene.find("applied_force"), more);
  std::ofstream{sceneFile()} << scene;
  test::ChildProcess daemon{daemonCommand("auto")};
  Probe probe{domain(), "auto"};
  const SceneHead head = probe.scene();
  EXPECT_THAT(head.effects, Not(Contains("platelets")));
  EXPECT_THAT(head.effects, Contains("surface_tension"));
  EXPECT_THAT(head.text, HasSubstr("platelets {"));
  const StatusHead status = probe.status();
  EXPECT_THAT(status.text, HasSubstr("auto: platelets off: the horizon, 0.01 s, is below 1 %"));
  EXPECT_THAT(status.text, HasSubstr("auto: surface_tension on: the smallest feature, wounds[0] of 6 mm"));
  EXPECT_THAT(status.text, HasSubstr("warning: surface_tension: drops boil at support_ratio 2; use 2.5 or more"));
  const auto told = [&probe](std::string_view beginning) {
    return probe.journal([beginning](const bleed_v1_Journal& journal) {
      return journal.body._d == bleed_v1_JOURNAL_DECISION && std::string_view{journal.body._u.decision}.starts_with(beginning);
    });
  };
  EXPECT_EQ(told("warning: surface_tension").step, 0U);
  const bleed_v1_Journal entry = told("auto: ");
  EXPECT_EQ(entry.step, 0U);
  EXPECT_THAT(entry.body._u.decision, HasSubstr("auto: "));
}

}  // namespace
}  // namespace bleedsim::service_test
