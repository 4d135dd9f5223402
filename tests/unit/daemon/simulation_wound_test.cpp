// Wounds by command in a scene that effects.auto has taken surface tension out of.
#include <gmock/gmock.h>
#include <thread>

#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

sph::AddWound disc(double radius) { return {{.name = {}, .shape = sph::DiscPatch{radius}}}; }
sph::UpdateWound narrowed(std::uint32_t id, double radius) {
  sph::UpdateWound update;
  update.wound_id = id;
  update.shape = sph::DiscPatch{radius};
  return update;
}

class WoundTest : public SimulationTest {
 protected:
  void startScene(const std::string& name) {
    simulation_ = std::make_unique<Simulation>(SimulationOptions{{dds::PaceMode::maximum, 1.0}, {}, {}}, fakeScene(name, log_),
                                               fakeFactory(log_), channels_, now_);
    tick();
    journal();
    channels_.board.takeScene();
  }
  /// A real world.
  void startWorld(const std::string& text) {
    const SceneFactory factory = worldFactory({});
    Result<LoadedScene> first = factory({text, {}});
    ASSERT_TRUE(first.ok()) << first.status().message();
    simulation_ = std::make_unique<Simulation>(SimulationOptions{{dds::PaceMode::maximum, 1.0}, {}, {}}, std::move(*first),
                                               factory, channels_, now_);
  }
  dds::Reply awaited() {
    dds::Reply out;
    for (int i = 0; i < 1'000'000; ++i) {
      if (channels_.replies.tryPop(out)) return out;
      tick();
      std::this_thread::yield();
    }
    ADD_FAILURE() << "no reply";
    return out;
  }
};

TEST_F(WoundTest, ANarrowWoundBringsTensionAtTheStepAtWhichItOpens) {
  startScene("no tension");
  EXPECT_EQ(channels_.board.read().report.text, "auto: surface_tension off");
  push(disc(0.0005));
  tick();
  EXPECT_TRUE(simulation_->world().wounds().empty()) << "not without tension";
  const dds::Reply opened = awaited();
  EXPECT_EQ(opened.code, dds::ReplyCode::accepted) << opened.reason;
  EXPECT_EQ(opened.object_id, 1U);
  EXPECT_EQ(log_->adoptions, 1);
  ASSERT_TRUE(log_->session);
  EXPECT_EQ(log_->session->speed_of_sound, 3.0);
  EXPECT_EQ(log_->session->narrowest_wound, 0.001);
  EXPECT_EQ(log_->applied.back().first + 1, opened.applied_step) << "the wound went into the new world";
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);

  const auto scene = channels_.board.takeScene();
  ASSERT_NE(scene, nullptr);
  EXPECT_THAT(scene->effects, ElementsAre("surface_tension"));
  EXPECT_EQ(channels_.board.read().report.text, "auto: surface_tension on");
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(std::get<dds::Switched>(entries[0].input).narrowest_wound, 0.001);
  EXPECT_FALSE(std::get<dds::Switched>(entries[0].input).by_request);
  EXPECT_EQ(std::get<dds::Decision>(entries[1].input).text, "auto: surface_tension on");
  EXPECT_EQ(std::get<dds::RequestTaken>(entries[2].input).object_id, 1U);
  EXPECT_EQ(entries[0].step, entries[2].step) << "one step boundary";
  EXPECT_EQ(entries[2].step + 1, opened.applied_step);
}

TEST_F(WoundTest, WhatWaitsAtTheEndIsAnswered) {
  startScene("no tension");
  push(disc(0.0005));
  push(dds::ShutdownSession{});
  push(dds::Ping{});
  EXPECT_EQ(tick().kind, Simulation::Next::Kind::stop);
  EXPECT_EQ(reply().code, dds::ReplyCode::accepted) << "the end itself";
  for (int i = 0; i < 2; ++i) {
    const dds::Reply refused = reply();
    EXPECT_EQ(refused.code, dds::ReplyCode::state);
    EXPECT_THAT(refused.reason, HasSubstr("the session ends"));
  }
}

TEST_F(WoundTest, AWideWoundOpensAtOnce) {
  startScene("no tension");
  EXPECT_EQ(ask(disc(0.01)).code, dds::ReplyCode::accepted);
  EXPECT_EQ(log_->adoptions, 0);
  EXPECT_FALSE(log_->session);
}

TEST_F(WoundTest, AWoundThatIsMadeNarrowBringsTension) {
  startScene("no tension");
  ask(disc(0.01));
  sph::UpdateWound moved;
  moved.wound_id = 1;
  moved.position = sph::Vec3{0.01, 0.0, 0.0};
  push(moved);
  awaited();
  EXPECT_FALSE(log_->session) << "the place decides nothing";
  push(narrowed(1, 0.001));
  awaited();
  EXPECT_EQ(log_->adoptions, 1);
}

TEST_F(WoundTest, CommandsOfWoundsKeepTheirOrderWhileOneWaits) {
  startScene("no tension");
  push(disc(0.0005));
  push(disc(0.01));
  push(sph::RemoveWound{1});
  push(dds::Ping{});
  tick();
  EXPECT_EQ(reply().key.seq, 4U) << "others go on";
  EXPECT_EQ(awaited().key.seq, 1U);
  EXPECT_EQ(awaited().key.seq, 2U);
  const dds::Reply removed = awaited();
  EXPECT_EQ(removed.key.seq, 3U);
  EXPECT_EQ(removed.code, dds::ReplyCode::accepted);
  ASSERT_EQ(simulation_->world().wounds().size(), 1U);
  EXPECT_EQ(log_->adoptions, 1);
}

TEST_F(WoundTest, StepsByHandComeAfterTheWoundThatWasAskedForBeforeThem) {
  startScene("no tension");
  ask(dds::PauseSession{});
  const std::uint64_t before = simulation_->world().stepCount();
  push(disc(0.0005));
  push(dds::StepSession{3});
  tick();
  EXPECT_EQ(reply().key.seq, 3U);
  EXPECT_EQ(simulation_->world().stepCount(), before);
  const dds::Reply opened = awaited();
  EXPECT_EQ(opened.applied_step, before + 1);
  ticks(4);
  EXPECT_EQ(simulation_->world().stepCount(), before + 3);
}

TEST_F(WoundTest, KeepsRoomForTheRepliesOfWhatWaits) {
  startScene("no tension");
  for (int i = 0; i < 64; ++i) push(disc(0.0005));
  tick();
  dds::Reply other;
  while (channels_.replies.tryPush(dds::Reply{other}, Channels::kRepliesOfSimulation)) {}
  push(dds::Ping{});
  for (int i = 0; i < 1'000'000 && simulation_->world().wounds().size() < 64; ++i) {
    tick();
    std::this_thread::yield();
  }
  EXPECT_EQ(channels_.counters.value(ServiceCounter::replies_lost), 0U);
  EXPECT_EQ(simulation_->world().wounds().size(), 64U);
}

TEST_F(WoundTest, WhatReplacesTheWorldIsRefusedWhileOneWaits) {
  startScene("no tension");
  push(disc(0.0005));
  push(dds::ResetSession{});
  push(dds::LoadScene{"second"});
  push(dds::SetEffect{"repulsion", true, ""});
  tick();
  for (int i = 0; i < 3; ++i) {
    const dds::Reply refused = reply();
    EXPECT_EQ(refused.code, dds::ReplyCode::state);
    EXPECT_THAT(refused.reason, HasSubstr("surface tension is being switched on for a wound: send this again"));
  }
  EXPECT_EQ(awaited().key.seq, 1U);
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);
}

TEST_F(WoundTest, WaitsForAnEffectThatIsBeingSwitched) {
  startScene("no tension");
  push(dds::SetEffect{"repulsion", true, ""});
  push(disc(0.0005));
  tick();
  EXPECT_EQ(awaited().key.seq, 1U);
  EXPECT_EQ(awaited().key.seq, 2U);
  EXPECT_EQ(log_->adoptions, 2);
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);
}

TEST_F(WoundTest, IsRefusedWithTheReasonIfTensionCannotBeSwitchedOn) {
  startScene("stuck");
  push(disc(0.0005));
  push(disc(0.01));
  const dds::Reply narrow = awaited();
  EXPECT_EQ(narrow.code, dds::ReplyCode::failed);
  EXPECT_EQ(narrow.reason, "no surface tension for this wound: no memory for another world");
  EXPECT_EQ(awaited().code, dds::ReplyCode::accepted) << "the wide one can do without";
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);

  startScene("no tension");
  log_->refuse_adoption = true;
  push(disc(0.0005));
  const dds::Reply full = awaited();
  EXPECT_EQ(full.code, dds::ReplyCode::capacity);
  EXPECT_THAT(full.reason, HasSubstr("no room"));
  EXPECT_TRUE(simulation_->world().wounds().empty());
  EXPECT_TRUE(journal().empty());
}

TEST_F(WoundTest, ARefusedWoundSwitchesNothing) {
  startScene("no tension");
  log_->refuse_wounds = true;
  EXPECT_EQ(ask(disc(0.0005)).code, dds::ReplyCode::invalid);
  EXPECT_FALSE(log_->session);
}

TEST_F(WoundTest, TooManyThatWaitAreRefused) {
  startScene("no tension");
  for (int i = 0; i < 65; ++i) push(disc(0.0005));
  tick();
  const dds::Reply refused = reply();
  EXPECT_EQ(refused.key.seq, 65U);
  EXPECT_EQ(refused.code, dds::ReplyCode::capacity);
  EXPECT_THAT(refused.reason, HasSubstr("64 wound commands wait"));
  for (std::uint64_t i = 1; i <= 64; ++i) EXPECT_EQ(awaited().key.seq, i);
  EXPECT_EQ(log_->adoptions, 1);
}

TEST_F(WoundTest, TheNarrowestIsRememberedUntilTheNextEpoch) {
  startScene("no tension");
  push(disc(0.0005));
  awaited();
  push(dds::SetEffect{"repulsion", true, ""});
  awaited();
  EXPECT_EQ(log_->session->narrowest_wound, 0.001);
  push(dds::ResetSession{});
  tick();
  loadUntilDone();
  reply();
  push(dds::SetEffect{"repulsion", true, ""});
  awaited();
  EXPECT_EQ(log_->session->narrowest_wound, std::numeric_limits<double>::infinity());
}

/// A block of blood 10 mm high that has fallen apart for a while: nothing is narrower than 3 capillary lengths.
constexpr const char* kBlockScene =
    R"(domain { lower_m { x: -0.04 y: -0.04 z: -0.02 } upper_m { x: 0.04 y: 0.04 z: 0.04 } capacity: 4000 }
resolution { spacing_m: 0.002 support_ratio: 2.5 }
compressibility { design_speed_m_per_s: 0.5 max_fall_or_depth_m: 0.01 }
effects { gravity {} pressure {} viscosity {} surface_tension {} auto: "surface_tension" }
tissue { plane { normal { z: 1 } } }
fluid_blocks { lower_m { x: -0.01 y: -0.01 } upper_m { x: 0.01 y: 0.01 z: 0.01 } }
)";

TEST_F(WoundTest, OneInsideTissueIsRefusedWithTheReasonAndNotWrittenDown) {
  startWorld(kBlockScene);
  tick();
  journal();
  sph::WoundDescription wound{.name = {}, .position = {0.02, 0.0, -0.005}, .shape = sph::DiscPatch{0.004}};
  const dds::Reply inside = ask(sph::AddWound{wound});
  EXPECT_EQ(inside.code, dds::ReplyCode::invalid);
  EXPECT_EQ(inside.reason, "wound position (0.02, 0, -0.005) m is 5 mm inside tissue: use (0.02, 0, 0) m, on the surface");
  EXPECT_LT(inside.reason.size(), 128U) << "a reply has no room for more";
  wound.position.z() = 0.0;
  wound.normal = -sph::Vec3::UnitZ();
  EXPECT_THAT(ask(sph::AddWound{wound}).reason, HasSubstr("turn it to the blood's side, (0, 0, 1)"));
  EXPECT_TRUE(journal().empty());
  EXPECT_TRUE(simulation_->world().wounds().empty());
  wound.normal = sph::Vec3::UnitZ();
  const dds::Reply on_it = ask(sph::AddWound{wound});
  ASSERT_EQ(on_it.code, dds::ReplyCode::accepted) << on_it.reason;
  journal();
  sph::UpdateWound moved;
  moved.wound_id = on_it.object_id;
  moved.position = sph::Vec3{0.02, 0.0, -0.002};
  EXPECT_EQ(ask(moved).code, dds::ReplyCode::invalid);
  EXPECT_TRUE(journal().empty());
}

// One step of 0.2 ms changes a speed of 0.2 m/s by gravity alone by 1 %, the energy by 2 %; an impulse of tension is more than 5
// %.
TEST_F(WoundTest, TheBloodThatRunsFeelsNoImpulse) {
  startWorld(kBlockScene);
  ticks(200);
  const auto energy = [this] {
    sph::WorldStats stats;
    simulation_->world().collectStats(stats);
    return stats.kinetic_energy;
  };
  sph::AddWound wound = disc(0.003);
  wound.wound.position = {0.025, 0.0, 0.0};
  wound.wound.drive = sph::FlowDrive{1e-7};
  push(wound);
  double before = 0.0;
  dds::Reply opened;
  for (int i = 0; i < 1'000'000; ++i) {
    before = energy();
    tick();
    if (channels_.replies.tryPop(opened)) break;
  }
  ASSERT_EQ(opened.code, dds::ReplyCode::accepted) << opened.reason;
  EXPECT_TRUE(sph::effectEnabled(simulation_->world().description(), "surface_tension"));
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);
  EXPECT_EQ(simulation_->world().stepCount(), opened.applied_step);
  EXPECT_NEAR(energy() / before, 1.0, 0.05);
  EXPECT_THAT(channels_.board.read().report.text,
              HasSubstr("auto: surface_tension on: the smallest feature, a wound by command of 6 mm"));
}

// Without gravity tension stays. The world with gravity is decided on without the wound that opens while it is built.
TEST_F(WoundTest, AWoundThatCameDuringASwitchCounts) {
  std::string text = kBlockScene;
  text.replace(text.find("gravity {} "), 11, "");
  startWorld(text);
  const auto acts = [this](const char* name) { return sph::effectEnabled(simulation_->world().description(), name); };
  ASSERT_TRUE(acts("surface_tension"));
  sph::AddWound wound = disc(0.003);
  wound.wound.position = {0.025, 0.0, 0.0};
  wound.wound.drive = sph::FlowDrive{1e-7};
  push(dds::SetEffect{"gravity", true, ""});
  push(wound);
  EXPECT_EQ(awaited().key.seq, 2U) << "tension is there";
  EXPECT_EQ(awaited().code, dds::ReplyCode::accepted);
  ASSERT_TRUE(acts("gravity"));
  for (int i = 0; i < 20'000 && !acts("surface_tension"); ++i) tick();
  EXPECT_TRUE(acts("surface_tension"));
}

}  // namespace
}  // namespace bleedsim::daemon
