#include <gmock/gmock.h>
#include <thread>

#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SwitchingTest : public SimulationTest {
 protected:
  /// Ticks until the switch is answered; the world goes on meanwhile.
  dds::Reply switched(dds::SetEffect set) {
    push(std::move(set));
    return awaited();
  }
  dds::Reply awaited() {
    dds::Reply out;
    for (int i = 0; i < 1'000'000; ++i) {
      tick();
      if (channels_.replies.tryPop(out)) return out;
      std::this_thread::yield();
    }
    ADD_FAILURE() << "no reply";
    return out;
  }
};

TEST_F(SwitchingTest, TheNewWorldGoesOnWhereTheOldOneWas) {
  start();
  ticks(20);
  const std::uint32_t epoch = simulation_->epoch();
  ask(sph::AddWound{});
  channels_.board.takeScene();
  journal();
  const dds::Reply done = switched({"surface_tension", true, ""});
  EXPECT_EQ(done.code, dds::ReplyCode::accepted) << done.reason;
  EXPECT_EQ(done.epoch, epoch);
  EXPECT_EQ(log_->adoptions, 1);
  EXPECT_EQ(log_->session->speed_of_sound, 3.0) << "the speed of sound is kept";
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);
  EXPECT_EQ(simulation_->world().stepCount(), done.applied_step) << "the tick that switched went on to the next step";
  EXPECT_EQ(simulation_->state(), dds::SessionState::running);

  const auto scene = channels_.board.takeScene();
  ASSERT_NE(scene, nullptr) << "the scene is published again";
  EXPECT_EQ(scene->epoch, epoch);
  EXPECT_THAT(scene->effects, ElementsAre("surface_tension"));
  EXPECT_EQ(scene->text, "first+surface_tension");
  EXPECT_EQ(scene->loaded_text, "first");
  EXPECT_THAT(scene->known_effects, testing::Contains("surface_tension"));
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].step + 1, done.applied_step);
  EXPECT_TRUE(std::holds_alternative<dds::RequestTaken>(entries[0].input));
}

TEST_F(SwitchingTest, InputsThatArriveMeanwhileAreNotLost) {
  start();
  push(dds::SetEffect{"repulsion", true, ""});
  push(sph::AddWound{});
  tick();
  EXPECT_EQ(reply().key.seq, 2U) << "the wound is answered at once";
  EXPECT_EQ(awaited().key.seq, 1U);
  EXPECT_EQ(simulation_->world().wounds().size(), 1U);
}

TEST_F(SwitchingTest, SwitchesInAPause) {
  start();
  ticks(5);
  ask(dds::PauseSession{});
  const std::uint64_t step = simulation_->world().stepCount();
  push(dds::SetEffect{"repulsion", true, ""});
  tick();
  while (log_->adoptions == 0) {
    channels_.commands.wakeup().wait({});
    tick();
  }
  EXPECT_EQ(reply().applied_step, step + 1);
  EXPECT_EQ(simulation_->world().stepCount(), step);
  EXPECT_EQ(simulation_->state(), dds::SessionState::paused);
}

TEST_F(SwitchingTest, ARefusalLeavesNoTrace) {
  start();
  channels_.board.takeScene();
  const dds::Reply bad = switched({"repulsion", true, "bad"});
  EXPECT_EQ(bad.code, dds::ReplyCode::invalid);
  EXPECT_THAT(bad.reason, HasSubstr("effects.x: value bad"));
  log_->refuse_adoption = true;
  const dds::Reply full = switched({"repulsion", true, ""});
  EXPECT_EQ(full.code, dds::ReplyCode::capacity);
  EXPECT_THAT(full.reason, HasSubstr("no room"));
  EXPECT_EQ(channels_.board.takeScene(), nullptr);
  EXPECT_TRUE(journal().empty());
  EXPECT_EQ(log_->adoptions, 0);
}

TEST_F(SwitchingTest, IsRefusedWhileAWorldIsBuiltAndRefusesOthersMeanwhile) {
  start();
  push(dds::ResetSession{});
  push(dds::SetEffect{"repulsion", true, ""});
  tick();
  const dds::Reply loading = reply();
  EXPECT_EQ(loading.code, dds::ReplyCode::state);
  EXPECT_THAT(loading.reason, HasSubstr("being loaded"));
  loadUntilDone();
  reply();
  push(dds::SetEffect{"repulsion", true, ""});
  push(dds::SetEffect{"adhesion", true, ""});
  push(dds::ResetSession{});
  tick();
  for (int i = 0; i < 2; ++i) {
    const dds::Reply refused = reply();
    EXPECT_EQ(refused.code, dds::ReplyCode::state);
    EXPECT_THAT(refused.reason, HasSubstr("being switched"));
  }
  EXPECT_EQ(awaited().code, dds::ReplyCode::accepted);
}

TEST_F(SwitchingTest, IsRefusedOnceTheSolverHasStopped) {
  log_->fail_at_step = 3;
  start();
  ticks(5);
  const dds::Reply refused = ask(dds::SetEffect{"repulsion", true, ""});
  EXPECT_EQ(refused.code, dds::ReplyCode::state);
}

TEST_F(SwitchingTest, ResetGoesBackToTheSceneAsItWasLoaded) {
  start();
  ASSERT_EQ(switched({"repulsion", true, ""}).code, dds::ReplyCode::accepted);
  push(dds::ResetSession{});
  tick();
  loadUntilDone();
  const auto scene = channels_.board.takeScene();
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->text, "first");
  EXPECT_THAT(scene->effects, testing::IsEmpty());
}

TEST_F(SwitchingTest, AnAttributeGoesWithItsEffect) {
  start();
  ASSERT_EQ(switched({"platelets", true, ""}).code, dds::ReplyCode::accepted);
  EXPECT_EQ(ask(dds::SetOutput{1000.0, sph::kFramePlatelet | sph::kFrameVelocity}).code, dds::ReplyCode::accepted);
  const dds::Reply radius = ask(dds::SetOutput{{}, sph::kFrameRadius});
  EXPECT_EQ(radius.code, dds::ReplyCode::unsupported);
  EXPECT_THAT(radius.reason, HasSubstr("no core_radius effect"));
  tick();
  EXPECT_EQ(channels_.frames.load()->frame.attributes, sph::kFramePlatelet | sph::kFrameVelocity);
  ASSERT_EQ(switched({"platelets", false, ""}).code, dds::ReplyCode::accepted);
  tick();
  EXPECT_EQ(channels_.frames.load()->frame.attributes, static_cast<std::uint32_t>(sph::kFrameVelocity));
}

TEST_F(SwitchingTest, DecisionsStandInTheJournalAndTheStatus) {
  start();
  ASSERT_EQ(switched({"platelets", true, "decide"}).code, dds::ReplyCode::accepted);
  const std::vector<dds::JournalEntry> entries = journal();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(std::get<dds::Decision>(entries[1].input).text, "auto: decided");
  EXPECT_EQ(channels_.board.read().report.text, "auto: decided");
}

}  // namespace
}  // namespace bleedsim::daemon
