// A session whose solver stopped: it stays up, says so, and a reset or another scene brings it back.
#include <gmock/gmock.h>
#include <thread>

#include "service/daemon/service.h"
#include "tests/integration/service/faulting_world.h"
#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr auto kFaulted = static_cast<std::uint32_t>(bleed_v1_STATE_FAULTED);
constexpr auto kRunning = static_cast<std::uint32_t>(bleed_v1_STATE_RUNNING);
constexpr auto kAccepted = static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED);
constexpr auto kState = static_cast<std::uint32_t>(bleed_v1_REPLY_STATE);

class FaultTest : public ServiceTest {
 protected:
  /// Starts a service in this process and lets its first world stop once frames of it arrive; those after it do not stop.
  void SetUp() override {
    ServiceTest::SetUp();
    sph::WorldOptions world;
    world.threads = 1;
    const daemon::SceneFactory factory = daemon::worldFactory(world);
    Result<daemon::LoadedScene> first = factory({smallScene(), {}});
    ASSERT_TRUE(first) << first.status().message();
    first->world = std::make_unique<FaultingWorld>(std::move(first->world), faults_);
    daemon::ServiceOptions options;
    options.participant.domain = domain();
    options.session = "fault";
    options.simulation.pace = {dds::PaceMode::maximum, 1.0};
    auto service = daemon::Service::create(options, std::move(*first), factory);
    ASSERT_TRUE(service) << service.status().message();
    service_ = std::move(*service);
    thread_ = std::thread{[this] { ended_ = service_->run(); }};
    probe_.emplace(domain(), "fault");
    probe_->frame([](const FrameHead& frame) { return frame.count > 0; });
    faults_ = true;
    faulted_ = waitFor(kFaulted);
  }
  void TearDown() override {
    if (service_) service_->requestStop();
    if (thread_.joinable()) thread_.join();
    EXPECT_TRUE(ended_.ok()) << ended_.message();
    probe_.reset();
    service_.reset();
    ServiceTest::TearDown();
  }

  StatusHead waitFor(std::uint32_t state) {
    return probe_->status([state](const StatusHead& status) { return status.state == state; });
  }
  bleed_v1_Reply load(std::string text) {
    return probe_->ask(bleed_v1_REQUEST_LOAD_SCENE, [&text](auto& body) { body._u.load_scene.text = text.data(); });
  }
  bool showsSteps(std::uint32_t epoch) {
    return probe_->frame([epoch](const FrameHead& frame) { return frame.epoch == epoch && frame.step > 50; }).epoch == epoch;
  }

  std::unique_ptr<daemon::Service> service_;
  std::thread thread_;
  Status ended_;
  std::atomic<bool> faults_{false};
  StatusHead faulted_;
  std::optional<Probe> probe_;
};

TEST_F(FaultTest, StaysUpAndSaysWhatHappenedAndWhatToDo) {
  EXPECT_THAT(faulted_.text, AllOf(HasSubstr("the solver stopped: the velocity of particle 7 is not finite"),
                                   HasSubstr("reset the session or load another scene")));
  const StatusHead later = probe_->status([&](const StatusHead& s) { return s.heartbeat > faulted_.heartbeat + 3; });
  EXPECT_EQ(later.state, kFaulted);
  EXPECT_EQ(later.step, faulted_.step);
  probe_->frame([&](const FrameHead& frame) { return frame.step == faulted_.step && frame.count > 0; });
  const bleed_v1_Journal entry =
      probe_->journal([](const bleed_v1_Journal& journal) { return journal.body._d == bleed_v1_JOURNAL_DECISION; });
  EXPECT_EQ(entry.step, faulted_.step) << "a recording tells it, too";
}

TEST_F(FaultTest, AnswersEveryCommandButGoesOnForNone) {
  EXPECT_EQ(probe_->ask(bleed_v1_REQUEST_PING).code, kAccepted);
  for (const std::uint32_t kind : {bleed_v1_REQUEST_RESUME, bleed_v1_REQUEST_PAUSE, bleed_v1_REQUEST_STEP}) {
    const bleed_v1_Reply refused = probe_->ask(kind, [kind](auto& body) {
      if (kind == bleed_v1_REQUEST_STEP) body._u.step.count = 1;
    });
    EXPECT_EQ(refused.code, kState) << kind;
    EXPECT_THAT(refused.reason, HasSubstr("reset or load a scene")) << kind;
  }
  const bleed_v1_Reply force = probe_->ask(bleed_v1_REQUEST_FORCE, [](auto& body) {
    body._u.force = {{0.0, 0.0, 0.0}, 0.01, {0.0, 0.0, 1e-3}, 0.1};
  });
  EXPECT_EQ(force.code, kState) << force.reason;
  EXPECT_EQ(waitFor(kFaulted).step, faulted_.step);
}

TEST_F(FaultTest, AResetBringsItBack) {
  const bleed_v1_Reply reset = probe_->ask(bleed_v1_REQUEST_RESET);
  EXPECT_EQ(reset.code, kAccepted) << reset.reason;
  EXPECT_EQ(reset.epoch, 2U);
  EXPECT_TRUE(showsSteps(2));
  EXPECT_EQ(waitFor(kRunning).text, "");
}

TEST_F(FaultTest, AnotherSceneBringsItBack) {
  const bleed_v1_Reply loaded = load(smallScene(0.2));
  EXPECT_EQ(loaded.code, kAccepted) << loaded.reason;
  EXPECT_TRUE(showsSteps(2));
}

TEST_F(FaultTest, ASceneWithProblemsLeavesItAsItWas) {
  EXPECT_EQ(load("name: 7").code, static_cast<std::uint32_t>(bleed_v1_REPLY_SCENE));
  const StatusHead still = waitFor(kFaulted);
  EXPECT_THAT(still.text, HasSubstr("the solver stopped"));
  EXPECT_EQ(probe_->ask(bleed_v1_REQUEST_RESET).code, kAccepted) << "and can still be reset";
}

}  // namespace
}  // namespace bleedsim::service_test
