// How bleedd starts and ends.
#include <array>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/wait.h>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::HasSubstr;

TEST_F(ServiceTest, ASecondDaemonOfTheSameSessionRefusesToStart) {
  test::ChildProcess first{daemonCommand("one")};
  Probe probe{domain(), "one"};
  probe.status();
  test::ChildProcess second{daemonCommand("one")};
  EXPECT_EQ(second.wait(), 3);
  EXPECT_THAT(second.output(), testing::AllOf(HasSubstr("session 'one'"), HasSubstr(std::to_string(first.pid()))));
  const std::uint64_t step = probe.frame().step;
  probe.frame([&](const FrameHead& frame) { return frame.step > step; });
}

TEST_F(ServiceTest, OfTwoDaemonsThatStartTogetherExactlyOneStays) {
  test::ChildProcess left{daemonCommand("both")};
  test::ChildProcess right{daemonCommand("both")};
  std::array<pollfd, 2> ends{{{left.endDescriptor(), POLLIN, 0}, {right.endDescriptor(), POLLIN, 0}}};
  ASSERT_GT(poll(ends.data(), ends.size(), 60'000), 0) << "both stayed";
  test::ChildProcess& loser = ends[0].revents != 0 ? left : right;
  test::ChildProcess& winner = ends[0].revents != 0 ? right : left;
  EXPECT_EQ(loser.wait(), 3);
  Probe probe{domain(), "both"};
  const StatusHead status = probe.status([](const StatusHead& head) { return head.heartbeat > 12; });
  EXPECT_EQ(status.pid, winner.pid());
  EXPECT_EQ(status.state, static_cast<std::uint32_t>(bleed_v1_STATE_RUNNING));
}

// Neither hears the other while the first is stopped, so both are established when they meet.
TEST_F(ServiceTest, OfTwoEstablishedDaemonsTheOlderStays) {
  const auto established = [](pid_t pid) {
    return [pid](const StatusHead& head) { return head.pid == pid && head.heartbeat > 12; };
  };
  test::ChildProcess first{daemonCommand("again")};
  Probe probe{domain(), "again"};
  probe.status(established(first.pid()));
  first.signal(SIGSTOP);
  siginfo_t stopped{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(first.pid()), &stopped, WSTOPPED | WNOWAIT), 0);
  test::ChildProcess second{daemonCommand("again")};
  const StatusHead seen = probe.status(established(second.pid()));
  first.signal(SIGCONT);
  EXPECT_EQ(second.wait(), 3) << "both stayed";
  EXPECT_THAT(second.output(), HasSubstr(std::to_string(first.pid())));
  const std::uint64_t step = probe.frame([&](const FrameHead& frame) { return frame.session != seen.session; }).step;
  probe.frame([&](const FrameHead& frame) { return frame.session != seen.session && frame.step > step; });
}

class SignalTest : public ServiceTest, public testing::WithParamInterface<int> {};

TEST_P(SignalTest, EndsTheDaemonCleanly) {
  test::ChildProcess daemon{daemonCommand("end")};
  Probe probe{domain(), "end"};
  probe.frame();
  daemon.signal(GetParam());
  EXPECT_EQ(daemon.wait(), 0);
  probe.status([](const StatusHead& status) { return status.state == bleed_v1_STATE_STOPPED; });
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalTest, testing::Values(SIGINT, SIGTERM));

TEST_F(ServiceTest, AShutdownRequestIsAnsweredAndEndsTheDaemon) {
  test::ChildProcess daemon{daemonCommand("down")};
  Probe probe{domain(), "down"};
  EXPECT_EQ(probe.ask(bleed_v1_REQUEST_SHUTDOWN).code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED));
  EXPECT_EQ(daemon.wait(), 0);
}

TEST_F(ServiceTest, EndsAfterItsDuration) {
  test::ChildProcess daemon{daemonCommand("short", {"--pace", "max", "--duration", "0.2"})};
  EXPECT_EQ(daemon.wait(), 0);
}

TEST_F(ServiceTest, AMissingInterfaceIsNamedWithTheExistingOnes) {
  test::ChildProcess daemon{daemonCommand("none", {"--interface", "nosuch9"})};
  EXPECT_EQ(daemon.wait(), 1) << "it may come yet";
  EXPECT_THAT(daemon.output(), testing::AllOf(HasSubstr("nosuch9"), HasSubstr("lo")));
}

TEST_F(ServiceTest, ABrokenSceneIsAUsageError) {
  std::ofstream{sceneFile()} << "name: 'broken' wounds { flow_ml_per_s: nan }";
  test::ChildProcess daemon{daemonCommand("broken")};
  EXPECT_EQ(daemon.wait(), 2);
  EXPECT_THAT(daemon.output(), HasSubstr("flow_ml_per_s"));
}

TEST_F(ServiceTest, ACheckListsWhatOnlyTheSolverCanTell) {
  std::ofstream{sceneFile()}
      << "domain { lower_m { x: -0.03 y: -0.03 z: -0.01 } upper_m { x: 0.03 y: 0.03 z: 0.03 } capacity: 2000 }\n"
         "resolution { spacing_m: 0.002 } compressibility { design_speed_m_per_s: 0.3 }\n"
         "effects { pressure {} }\n"
         "wounds { disc { radius_m: 0.004 } flow_ml_per_s: 100 }\n"
         "wounds { position_m { x: 0.005 } disc { radius_m: 0.004 } flow_ml_per_s: 1 }\n"
         "wounds { position_m { x: 0.028 } disc { radius_m: 0.004 } flow_ml_per_s: 1 }\n"
         "fluid_blocks { lower_m { z: 0.02 } upper_m { x: 0.01 y: 0.01 z: 0.04 } }\n";
  test::ChildProcess daemon{daemonCommand("check", {"--check"})};
  EXPECT_EQ(daemon.wait(), 2);
  EXPECT_THAT(
      daemon.output(),
      testing::AllOf(HasSubstr("4 problems"), HasSubstr("wounds[0].flow_ml_per_s: value 100 is out of range, allowed 0 to"),
                     HasSubstr("wounds[1].position_m: value (0.005, 0, 0) overlaps wounds[0]"),
                     HasSubstr("wounds[2].position_m.x: value 0.028"), HasSubstr("fluid_blocks[0].upper_m.z: value 0.04")));
}

TEST_F(ServiceTest, ChecksASceneWithoutRunningIt) {
  test::ChildProcess daemon{daemonCommand("check", {"--check"})};
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_THAT(daemon.output(), HasSubstr("valid"));
}

TEST_F(ServiceTest, ListsTheEffectsOfAScene) {
  test::ChildProcess daemon{daemonCommand("list", {"--list-effects"})};
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_THAT(daemon.output(), testing::AllOf(HasSubstr("on         viscosity"), HasSubstr("off        surface_tension")));
}

}  // namespace
}  // namespace bleedsim::service_test
