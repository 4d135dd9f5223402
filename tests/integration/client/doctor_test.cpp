// "bleedctl doctor" against a real bleedd, and without one.
#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "service/transport/wait_set.h"
#include "service/transport/writer.h"
#include "tests/integration/client/json_value.h"
#include "tests/integration/client/running_daemon.h"
#include "tests/support/flat_scene.h"

namespace bleedsim::client_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint32_t kDomain = 69;

class DoctorTest : public testing::Test {
 protected:
  void SetUp() override {
    isolate();
    scene_ = fmt::format("{}/bleedsim_doctor_{}.textproto", testing::TempDir(), getpid());
    std::ofstream{scene_} << "name: 'small'\n" << test::FlatScene{.more = test::kCut}.text();
  }
  void TearDown() override { std::filesystem::remove(scene_); }

  std::unique_ptr<RunningDaemon> daemon() const { return RunningDaemon::start(BLEEDD_PATH, scene_, "theatre", kDomain); }
  static test::Finished doctor(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {BLEEDCTL_PATH, "doctor", "--domain", std::to_string(kDomain)});
    return test::runProcess(more);
  }

  std::string scene_;
};

TEST_F(DoctorTest, FindsNothingWrongWithAHealthySession) {
  const auto running = daemon();
  ASSERT_NE(running, nullptr);
  // A pace that it keeps on a busy machine as well.
  ASSERT_TRUE(running->session().pace({.mode = client::PaceMode::factor, .factor = 0.2}).get().accepted());
  const test::Finished shown = doctor();
  EXPECT_EQ(shown.code, 0) << shown.output;
  EXPECT_THAT(shown.output, AllOf(HasSubstr("Cyclone DDS 0."), HasSubstr("loopback only"), HasSubstr("receive buffer"),
                                  HasSubstr("'theatre' on "), HasSubstr("nothing is wrong"), Not(HasSubstr("PROBLEM"))));

  const test::Finished finished = doctor({"--json"});
  ASSERT_EQ(finished.code, 0) << finished.output;
  const Json json = parseJson(finished.output);
  EXPECT_EQ(number(json, "problems"), 0.0);
  const auto& sessions = member(json, "sessions").list_value();
  ASSERT_EQ(sessions.values_size(), 1);
  EXPECT_EQ(text(sessions.values(0), "session"), "theatre");
  EXPECT_EQ(number(sessions.values(0), "pid"), running->process().pid());
  EXPECT_GT(number(sessions.values(0), "round_trip_s"), 0.0);
  // Both programs read the same clock.
  EXPECT_LT(std::abs(number(sessions.values(0), "clock_ahead_s")), 0.1);
  const Json& frame_topic = member(member(json, "topics"), "bleed/v1/frame");
  EXPECT_EQ(number(frame_topic, "writers"), 1.0);
  EXPECT_EQ(number(frame_topic, "readers"), 0.0) << "the doctor itself does not count";
  const auto& members = member(json, "members").list_value().values();
  const auto is_daemon = [&](const Json& one) {
    return text(one, "process") == "bleedd" && number(one, "pid") == running->process().pid();
  };
  EXPECT_EQ(std::count_if(members.begin(), members.end(), is_daemon), 1);
}

TEST_F(DoctorTest, NamesWhoeverWaitsForASessionThatDoesNotRun) {
  const auto participant = transport::Participant::create({.domain = kDomain});
  ASSERT_TRUE(participant.ok()) << participant.status().message();
  const auto writer = transport::Writer<bleed_v1_Request>::create(*participant, "theater");
  ASSERT_TRUE(writer.ok());
  const test::Finished finished = doctor();
  EXPECT_EQ(finished.code, 0) << finished.output;
  EXPECT_THAT(finished.output, AllOf(HasSubstr("somebody waits for session 'theater'"), HasSubstr("no session was found")));
}

TEST_F(DoctorTest, ASessionThatWasAskedForAndIsNotThereIsAProblem) {
  const test::Finished finished = doctor({"--session", "theatre"});
  EXPECT_EQ(finished.code, 1);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("PROBLEM  session 'theatre' was not found"), HasSubstr("-> start bleedd"),
                                     HasSubstr("1 problem\n")));
}

TEST_F(DoctorTest, AnInterfaceThatIsNotThereIsAProblemNotAWrongCommand) {
  const test::Finished finished = doctor({"--interface", "nosuch9", "--json"});
  EXPECT_EQ(finished.code, 1);
  EXPECT_THAT(finished.output, AllOf(HasSubstr("nosuch9"), HasSubstr("\"problems\": 1")));
}

}  // namespace
}  // namespace bleedsim::client_test
