// bleedctl as a process of its own, against a fake service here.
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/integration/client/bleedctl_fixture.h"

namespace bleedsim::client_test {
namespace {

using testing::HasSubstr;

TEST_F(BleedctlTest, ListsSessions) {
  const auto one = serve("one");
  const auto two = serve("two");
  const test::Finished text = bleedctl({"list"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.output, testing::AllOf(HasSubstr("one"), HasSubstr("two"), HasSubstr("running")));
  const test::Finished json = bleedctl({"list", "--json"});
  EXPECT_EQ(json.code, 0);
  EXPECT_EQ(json.output.front(), '[');
  EXPECT_THAT(json.output, HasSubstr(R"("session": "two")"));
}

TEST_F(BleedctlTest, ShowsStatusAndSceneWithOptionsOnEitherSide) {
  const auto service = serve("one");
  const test::Finished before = bleedctl({"--session", "one", "--json", "status"});
  EXPECT_EQ(before.code, 0) << before.output;
  const test::Finished after = bleedctl({"status", "--session", "one", "--json"});
  EXPECT_EQ(after.code, 0) << after.output;
  for (const test::Finished& finished : {before, after}) {
    EXPECT_THAT(finished.output, HasSubstr(R"("state": "running")"));
    EXPECT_THAT(finished.output, HasSubstr(R"("name": "round_wound")"));
  }
}

TEST_F(BleedctlTest, AMissingSessionHasCodeThreeAndNamesTheOthers) {
  const auto service = serve("one");
  const test::Finished finished = bleedctl({"pause", "--session", "other", "--timeout", "1"});
  EXPECT_EQ(finished.code, 3);
  EXPECT_THAT(finished.output, testing::AllOf(HasSubstr("'other'"), HasSubstr("one")));
}

TEST_F(BleedctlTest, SendsEveryCommandAndPrintsTheAnswer) {
  std::vector<std::uint32_t> kinds;
  std::uint64_t last_run = 0;
  const auto service = serve("one", [&kinds, &last_run](const bleed_v1_Request& request, bleed_v1_Reply& reply) {
    // On a busy machine a request is sent again; each process has a run of its own.
    if (request.run != last_run) kinds.push_back(request.body._d);
    last_run = request.run;
    reply.object_id = request.body._d == bleed_v1_REQUEST_WOUND_ADD ? 7 : 0;
    reply.applied_step = 55;
    return true;
  });
  const std::string scene = fmt::format("{}/bleedctl_{}.textproto", testing::TempDir(), getpid());
  std::ofstream{scene} << "name: \"x\"\n";
  const test::Finished added =
      bleedctl({"wound", "add", "--at", "-0.01,0,0", "--radius-mm", "2", "--flow-ml-per-s", "1.5", "--normal", "0,0,1"});
  EXPECT_EQ(added.code, 0) << added.output;
  EXPECT_THAT(added.output, testing::AllOf(HasSubstr("wound 7"), HasSubstr("step 55")));
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"wound", "move", "7", "--at", "0,0,0"},
           {"wound", "set", "7", "--flow-ml-per-s", "3", "--session", "one"},
           {"wound", "remove", "7"},
           {"force", "--at", "0,0,0", "--radius-mm", "5", "--newtons", "0,0,-1", "--duration", "0.5"},
           {"pause"},
           {"resume"},
           {"reset"},
           {"step", "10"},
           {"pace", "0.5"},
           {"load", scene}}) {
    const test::Finished finished = bleedctl(arguments);
    EXPECT_EQ(finished.code, 0) << arguments.front() << ": " << finished.output;
  }
  std::filesystem::remove(scene);
  EXPECT_EQ(kinds, (std::vector<std::uint32_t>{2, 3, 3, 4, 5, 6, 7, 8, 9, 10, 12}));
}

TEST_F(BleedctlTest, ARefusalHasCodeOneAndItsReason) {
  const auto service = serve("one", [](const bleed_v1_Request&, bleed_v1_Reply& reply) {
    reply.code = bleed_v1_REPLY_NOT_FOUND;
    std::string{"wound 99 is unknown"}.copy(reply.reason, sizeof reply.reason - 1);
    return true;
  });
  const test::Finished finished = bleedctl({"wound", "remove", "99"});
  EXPECT_EQ(finished.code, 1);
  EXPECT_THAT(finished.output, HasSubstr("wound 99 is unknown"));
}

TEST_F(BleedctlTest, ARefusedSceneBringsTheCheckAndNothingElseDoes) {
  std::atomic<std::uint32_t> code = bleed_v1_REPLY_SCENE;
  const auto service = serve("one", [&code](const bleed_v1_Request&, bleed_v1_Reply& reply) {
    reply.code = code;
    std::string{"the scene has 2 problems:"}.copy(reply.reason, sizeof reply.reason - 1);
    return true;
  });
  const std::string scene = fmt::format("{}/bleedctl_{}.textproto", testing::TempDir(), getpid());
  std::ofstream{scene} << "name: \"x\"\n";
  const std::string check = fmt::format("'bleedd --scene {} --check' lists all that is wrong", scene);
  const test::Finished refused = bleedctl({"load", scene});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.output, testing::AllOf(HasSubstr("2 problems"), HasSubstr(check)));
  for (const std::uint32_t other : {bleed_v1_REPLY_STATE, bleed_v1_REPLY_FAILED, bleed_v1_REPLY_ACCEPTED}) {
    code = other;
    EXPECT_THAT(bleedctl({"load", scene}).output, testing::Not(HasSubstr("--check"))) << other;
  }
  code = bleed_v1_REPLY_SCENE;
  EXPECT_THAT(bleedctl({"reset"}).output, testing::Not(HasSubstr("--check"))) << "a reset has no file to check";
  std::filesystem::remove(scene);
}

TEST_F(BleedctlTest, ASilentSessionHasCodeThree) {
  const auto service = serve("one", [](const bleed_v1_Request&, bleed_v1_Reply&) { return false; });
  EXPECT_EQ(bleedctl({"pause", "--timeout", "1"}).code, 3);
}

class BleedctlSignalTest : public BleedctlTest, public testing::WithParamInterface<int> {};

TEST_P(BleedctlSignalTest, EndsACommandThatWaitsForItsReply) {
  const auto service = serve("one", [](const bleed_v1_Request&, bleed_v1_Reply&) { return false; });
  test::ChildProcess pause{command({"pause", "--timeout", "600"})};
  ASSERT_TRUE(service->waitRequests(1));
  pause.signal(GetParam());
  EXPECT_EQ(pause.wait(), 130) << pause.output();
}

TEST_P(BleedctlSignalTest, EndsACommandThatWaitsForItsSession) {
  test::ChildProcess pause{command({"pause", "--session", "nowhere", "--timeout", "600"})};
  auto status = transport::Writer<bleed_v1_Status>::create(*participant_, "another");
  ASSERT_TRUE(status.ok());
  auto waits = transport::WaitSet::create(*participant_);
  ASSERT_TRUE(waits.ok() && waits->attachMatches(*status, 0).ok());
  while (status->matchedCount() == 0) ASSERT_TRUE(waits->wait(test::kPatience).ok());
  pause.signal(GetParam());
  EXPECT_EQ(pause.wait(), 130) << pause.output();
}

TEST_P(BleedctlSignalTest, EndsACommandThatWaitsForItsSessionToEnd) {
  const auto service = serve("one");
  test::ChildProcess shutdown{command({"shutdown", "--timeout", "600"})};
  ASSERT_TRUE(shutdown.waitForOutput("shut down"));
  shutdown.signal(GetParam());
  EXPECT_EQ(shutdown.wait(), 130) << shutdown.output();
}

INSTANTIATE_TEST_SUITE_P(Signals, BleedctlSignalTest, testing::Values(SIGINT, SIGTERM));

TEST_F(BleedctlTest, WatchPrintsFiguresUntilItIsInterrupted) {
  const auto service = serve("one");
  test::ChildProcess watch{command({"watch", "--json"}), false};
  ASSERT_TRUE(service->waitFrameReaders(1));
  ASSERT_TRUE(service->publishFrame(4).ok());
  auto line = watch.readLine();
  // A busy machine may take so long to bring the frame that the state is shown first.
  while (line && line->find("\"seq\"") == std::string::npos) line = watch.readLine();
  ASSERT_TRUE(line.has_value());
  EXPECT_THAT(*line, testing::AllOf(HasSubstr(R"("seq": 4)"), HasSubstr(R"("ml_emitted": 2)"), HasSubstr(R"("gaps": 0)")));
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 0);
}

TEST_F(BleedctlTest, WatchShowsTheStateWhereThereAreNoStatistics) {
  const auto service = serve("one");
  service->publishStatus(bleed_v1_STATE_PAUSED);
  test::ChildProcess watch{command({"watch", "--json"}), false};
  const auto paused = watch.readLine();
  ASSERT_TRUE(paused.has_value());
  EXPECT_THAT(*paused, testing::AllOf(HasSubstr(R"("state": "paused")"), HasSubstr(R"("step": 0)"),
                                      HasSubstr(R"("particles": 0)"), testing::Not(HasSubstr("seq"))));
  service->publishStatus(bleed_v1_STATE_LOADING);
  const auto loading = watch.readLine();
  ASSERT_TRUE(loading.has_value());
  EXPECT_THAT(*loading, HasSubstr(R"("state": "loading")"));
  ASSERT_TRUE(service->publishFrame(7).ok());
  const auto figures = watch.readLine();
  ASSERT_TRUE(figures.has_value());
  EXPECT_THAT(*figures, HasSubstr(R"("seq": 7)"));
  watch.signal(SIGINT);
  EXPECT_EQ(watch.wait(), 0);

  service->publishStatus(bleed_v1_STATE_PAUSED);
  const test::Finished text = bleedctl({"watch", "--count", "1"});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.output, testing::AllOf(HasSubstr("paused"), HasSubstr("step 70"), HasSubstr("no new frames")));
}

TEST_F(BleedctlTest, ShutdownWaitsUntilTheSessionIsGone) {
  auto service = serve("one");
  test::ChildProcess shutdown{command({"shutdown"})};
  ASSERT_TRUE(service->waitRequests(1));
  service->publishStatus(bleed_v1_STATE_STOPPED);
  EXPECT_EQ(shutdown.wait(), 0) << shutdown.output();
}

TEST_F(BleedctlTest, WrongUseHasCodeTwoAndAHint) {
  const test::Finished flag = bleedctl({"wound", "add", "--att", "0,0,0"});
  EXPECT_EQ(flag.code, 2);
  EXPECT_THAT(flag.output, HasSubstr("bleedctl wound add --help"));
  const test::Finished none = bleedctl({});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.output, testing::AllOf(HasSubstr("which command?"), HasSubstr("record"), HasSubstr("shutdown")));
  const test::Finished unknown = bleedctl({"wound", "open"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.output, testing::AllOf(HasSubstr("no command 'open'"), HasSubstr("add, move, set, remove")));
}

}  // namespace
}  // namespace bleedsim::client_test
