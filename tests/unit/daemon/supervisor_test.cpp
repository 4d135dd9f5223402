// What the service manager hears, and that a thread which hangs starves its watchdog.
#include "service/daemon/supervisor.h"

#include <algorithm>
#include <future>
#include <gmock/gmock.h>
#include <thread>

#include "tests/unit/daemon/captured_log.h"
#include "tests/unit/daemon/simulation_fixture.h"

namespace bleedsim::daemon {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::string kFed = "WATCHDOG=1";

class SupervisorTest : public SimulationTest {
 protected:
  void supervise(std::optional<Clock::duration> watchdog = seconds{4}) {
    const auto keep = [this](const std::string& lines) { told_.push_back(lines); };
    supervisor_ = std::make_unique<Supervisor>(channels_, ServiceManager{keep, watchdog}, now_);
  }
  void look() {
    now_ += supervisor_->period();
    supervisor_->look(now_);
  }
  /// The publisher's thread takes a turn if it was woken.
  void publisherTurn() {
    if (channels_.publisher.wait(Clock::now())) channels_.publisher_pulse.beat();
  }
  /// Both threads take the turns that they were woken for, as they do when they wait without a deadline.
  void turns() {
    if (channels_.commands.wakeup().wait(Clock::now())) tick();
    publisherTurn();
  }
  /// How often the watchdog was fed in these rounds of a look and the turns after it.
  auto fedIn(int rounds) {
    told_.clear();
    for (int i = 0; i < rounds; ++i) {
      look();
      turns();
    }
    return std::count(told_.begin(), told_.end(), kFed);
  }

  std::vector<std::string> told_;
  std::unique_ptr<Supervisor> supervisor_;
};

TEST_F(SupervisorTest, LooksSeveralTimesWithinTheWatchdogsTime) {
  supervise(seconds{2});
  EXPECT_EQ(supervisor_->period(), milliseconds{500});
  supervise(seconds{60});
  EXPECT_EQ(supervisor_->period(), seconds{1});
  supervise(milliseconds{1});
  EXPECT_EQ(supervisor_->period(), milliseconds{10});
  supervise({});
  EXPECT_EQ(supervisor_->period(), seconds{1});
}

TEST_F(SupervisorTest, FeedsTheWatchdogWhileTheSessionRuns) {
  start();
  supervise();
  turns();
  EXPECT_EQ(fedIn(10), 9) << "the first look only wakes";
}

TEST_F(SupervisorTest, FeedsTheWatchdogInAPauseThoughNoStepIsDone) {
  start();
  supervise();
  ASSERT_EQ(ask(dds::PauseSession{}).code, dds::ReplyCode::accepted);
  const std::uint64_t steps = simulation_->world().stepCount();
  fedIn(1);
  EXPECT_EQ(fedIn(10), 10);
  EXPECT_EQ(simulation_->world().stepCount(), steps);
}

TEST_F(SupervisorTest, FeedsTheWatchdogOfASolverThatStopped) {
  log_->fail_at_step = 2;
  start();
  supervise();
  ticks(3);
  ASSERT_EQ(simulation_->state(), dds::SessionState::faulted);
  fedIn(1);
  EXPECT_EQ(fedIn(5), 5) << "a reset helps, a restart would lose the recording's end";
  EXPECT_THAT(told_, Not(Contains(HasSubstr("STATUS=running"))));
}

TEST_F(SupervisorTest, FeedsTheWatchdogWhileASceneLoads) {
  std::promise<void> may_load;
  const std::shared_future<void> released = may_load.get_future().share();
  const SceneFactory slow = [this, released](const SceneJob& job) {
    released.wait();
    return fakeFactory(log_)(job);
  };
  simulation_ = std::make_unique<Simulation>(SimulationOptions{{dds::PaceMode::maximum, 1.0}, {}, {}}, fakeScene("first", log_),
                                             slow, channels_, now_);
  supervise();
  push(dds::ResetSession{});
  tick();
  ASSERT_EQ(simulation_->state(), dds::SessionState::loading);
  fedIn(1);
  EXPECT_EQ(fedIn(10), 10);
  may_load.set_value();
  loadUntilDone();
}

TEST_F(SupervisorTest, AStepThatHangsStarvesTheWatchdogAndIsNamed) {
  CapturedLog log;
  std::promise<void> hangs;
  std::promise<void> may_go_on;
  std::promise<void> goes_on;
  log_->before_step = [&](std::uint64_t number) {
    if (number == 3) {
      hangs.set_value();
      may_go_on.get_future().wait();
    }
    if (number == 4) goes_on.set_value();
  };
  start();
  std::thread simulating{[this] { simulation_->run(); }};
  hangs.get_future().wait();
  supervise();
  for (int i = 0; i < 10; ++i) {
    look();
    publisherTurn();
  }
  EXPECT_THAT(told_, Not(Contains(kFed)));
  EXPECT_THAT(told_, Contains(HasSubstr("the simulation thread stands still")));
  EXPECT_THAT(log.text(), HasSubstr("the simulation thread stands still since 5 s: the watchdog is not fed"));
  EXPECT_THAT(log.text(), Not(HasSubstr("publisher")));

  may_go_on.set_value();
  goes_on.get_future().wait();
  publisherTurn();
  look();
  EXPECT_THAT(told_, Contains(kFed));
  EXPECT_THAT(log.text(), HasSubstr("the simulation thread goes on after 11 s"));
  simulation_->requestStop();
  simulating.join();
}

TEST_F(SupervisorTest, APublisherThatHangsStarvesTheWatchdogToo) {
  CapturedLog log;
  start();
  supervise();
  for (int i = 0; i < 10; ++i) {
    look();
    tick();
  }
  EXPECT_THAT(told_, Not(Contains(kFed)));
  EXPECT_THAT(log.text(), HasSubstr("the publisher thread stands still"));
}

TEST_F(SupervisorTest, TellsThatItIsReadyOnceTheSessionIsShown) {
  start();
  supervise();
  fedIn(3);
  EXPECT_THAT(told_, Not(Contains("READY=1")));
  supervisor_->sessionShown();
  fedIn(3);
  EXPECT_EQ(std::count(told_.begin(), told_.end(), "READY=1"), 1);
}

TEST_F(SupervisorTest, TellsTheStateWhenItChangesAndNowAndThen) {
  start();
  supervise();
  const auto states = [this] {
    return std::count_if(told_.begin(), told_.end(), [](const std::string& lines) { return lines.starts_with("STATUS="); });
  };
  fedIn(10);
  EXPECT_EQ(states(), 2) << "every 5 s of 10";
  EXPECT_THAT(told_, Contains(HasSubstr("STATUS=running: real-time factor")));
  ask(dds::PauseSession{});
  fedIn(1);
  EXPECT_THAT(told_, Contains(HasSubstr("STATUS=paused: ")));
}

TEST_F(SupervisorTest, TheStateIsOneLine) {
  start();
  channels_.board.change([](dds::StatusReport& report) { report.text = "two\nWATCHDOG=1"; });
  supervise();
  look();
  EXPECT_THAT(told_, Contains(HasSubstr("; two WATCHDOG=1")));
  EXPECT_THAT(told_, Not(Contains(HasSubstr("\n"))));
}

TEST_F(SupervisorTest, TellsTheEndAndNothingAfterIt) {
  start();
  supervise();
  supervisor_->start();
  supervisor_->stop();
  ASSERT_FALSE(told_.empty());
  EXPECT_EQ(told_.back(), "STOPPING=1");
  const std::size_t count = told_.size();
  supervisor_->stop();
  EXPECT_EQ(told_.size(), count);
}

TEST_F(SupervisorTest, NeedsNoServiceManager) {
  CapturedLog log;
  start();
  supervisor_ = std::make_unique<Supervisor>(channels_, ServiceManager{}, now_);
  for (int i = 0; i < 6; ++i) look();
  EXPECT_THAT(log.text(), HasSubstr("the simulation thread stands still since 5 s\n"));
}

}  // namespace
}  // namespace bleedsim::daemon
