// Every command of bleedctl, as a process of its own, against a real bleedd.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <unistd.h>

#include "service/transport/wait_set.h"
#include "service/transport/writer.h"
#include "tests/integration/client/json_value.h"
#include "tests/integration/client/running_daemon.h"

namespace bleedsim::client_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint32_t kDomain = 68;
const std::string kScenes = SCENE_DIR "/";

class BleedctlBleeddTest : public testing::Test {
 protected:
  void SetUp() override {
    isolate();
    daemon_ = RunningDaemon::start(BLEEDD_PATH, kScenes + "round_wound.textproto", "theatre", kDomain);
    ASSERT_NE(daemon_, nullptr);
  }

  static test::Finished bleedctl(std::vector<std::string> arguments, bool with_stderr = true) {
    arguments.insert(arguments.begin(), {BLEEDCTL_PATH, "--domain", std::to_string(kDomain), "--timeout", "60"});
    return test::runProcess(arguments, with_stderr);
  }
  /// Runs a command that has to succeed and reads what it prints.
  static Json json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const test::Finished finished = bleedctl(std::move(arguments), false);
    EXPECT_EQ(finished.code, 0) << finished.output;
    return parseJson(finished.output);
  }
  /// What `status` prints, as soon as it fulfils the condition: an answer may overtake the status that tells of its effect.
  static Json statusWhere(const std::function<bool(const Json&)>& condition) {
    Json status;
    for (int attempt = 0; attempt < 100; ++attempt) {
      status = json({"status"});
      if (testing::Test::HasFailure() || condition(status)) return status;
    }
    ADD_FAILURE() << "the status stayed at " << status.ShortDebugString();
    return status;
  }
  /// The session's status as soon as it fulfils the condition.
  client::SessionStatus eventually(const std::function<bool(const client::SessionStatus&)>& condition) {
    const auto status = daemon_->session().waitStatus(condition, test::kPatience);
    EXPECT_TRUE(status.ok()) << status.status().message();
    return status.ok() ? *status : client::SessionStatus{};
  }

  std::unique_ptr<RunningDaemon> daemon_;
};

TEST_F(BleedctlBleeddTest, LeaseKeepsOthersFromCommandingUntilItEnds) {
  test::ChildProcess lease{{BLEEDCTL_PATH, "--domain", std::to_string(kDomain), "--timeout", "60", "lease"}};
  ASSERT_TRUE(lease.waitForOutput("leased until Ctrl-C")) << lease.output();
  const test::Finished refused = bleedctl({"pause"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.output, HasSubstr("has the lease for up to"));
  EXPECT_EQ(bleedctl({"lease", "--seconds", "1"}).code, 1);
  lease.signal(SIGINT);
  EXPECT_EQ(lease.wait(), 0);
  EXPECT_THAT(lease.output(), HasSubstr("released"));
  EXPECT_EQ(bleedctl({"pause"}).code, 0);

  const test::Finished short_one = bleedctl({"lease", "--seconds", "1"});
  EXPECT_EQ(short_one.code, 0);
  EXPECT_THAT(short_one.output, AllOf(HasSubstr("leased for 1 s"), HasSubstr("released")));
}

TEST_F(BleedctlBleeddTest, ListStatusAndWatchShowTheSession) {
  const Json sessions = json({"list"});
  ASSERT_EQ(sessions.list_value().values_size(), 1);
  EXPECT_EQ(text(sessions.list_value().values(0), "session"), "theatre");
  EXPECT_EQ(number(sessions.list_value().values(0), "pid"), daemon_->session().status()->pid);
  EXPECT_THAT(bleedctl({"list"}).output, HasSubstr("theatre"));

  const Json status = json({"status"});
  EXPECT_EQ(text(status, "state"), "running");
  EXPECT_EQ(text(status, "pace"), "realtime");
  EXPECT_EQ(number(status, "wounds"), 1.0);
  EXPECT_EQ(text(member(status, "scene"), "name"), "round_wound");
  EXPECT_EQ(number(member(status, "scene"), "spacing_m"), 0.003);
  EXPECT_GE(number(member(status, "counters"), "requests"), 0.0);
  EXPECT_THAT(bleedctl({"status", "--session", "theatre"}).output, HasSubstr("round_wound"));

  const test::Finished watched = bleedctl({"watch", "--count", "3", "--json"}, false);
  ASSERT_EQ(watched.code, 0) << watched.output;
  std::istringstream lines{watched.output};
  double seq = 0.0;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const Json figures = parseJson(line);
    EXPECT_GE(number(figures, "seq"), seq);
    seq = number(figures, "seq");
    EXPECT_GT(number(figures, "ml_emitted"), 0.0);
    EXPECT_GE(number(figures, "gaps"), 0.0);
    EXPECT_GT(number(figures, "real_time_factor"), 0.0);
    EXPECT_GE(number(figures, "max_density_error"), number(figures, "mean_density_error"));
    EXPECT_GT(number(figures, "steps_in_frame"), 0.0);
    EXPECT_GT(number(member(figures, "stage_costs_us"), "force"), 0.0);
  }
  EXPECT_EQ(count, 3);
  EXPECT_THAT(bleedctl({"watch", "--count", "1"}).output,
              AllOf(HasSubstr("density +"), HasSubstr("steps of"), HasSubstr(" us: ")));
}

TEST_F(BleedctlBleeddTest, WhatWentWrongIsCountedAndShown) {
  const auto participant = transport::Participant::create({.domain = kDomain});
  ASSERT_TRUE(participant.ok()) << participant.status().message();
  auto instrument = transport::Writer<bleed_v1_Instrument>::create(*participant, "theatre");
  auto waits = transport::WaitSet::create(*participant);
  ASSERT_TRUE(instrument.ok() && waits.ok() && waits->attachMatches(*instrument, 0).ok());
  while (instrument->matchedCount() == 0) ASSERT_TRUE(waits->wait(test::kPatience).ok());
  bleed_v1_Instrument sample{};
  sample.seq = 1;
  sample.orientation.w = 1.0;
  sample.force.z = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(instrument->write(sample).ok());
  // Nothing is up there to be pushed.
  ASSERT_EQ(bleedctl({"force", "--at", "0.04,0.04,0.03", "--radius-mm", "2", "--newtons", "0,0,-1", "--duration", "0.02"}).code,
            0);

  const auto counted = [](const Json& status) {
    const Json& counters = member(status, "counters");
    return number(counters, "instruments_malformed") == 1.0 && number(counters, "force_expired") == 1.0;
  };
  const Json status = statusWhere(counted);
  const double missed = number(member(status, "counters"), "force_without_fluid");
  EXPECT_GT(missed, 0.0);
  EXPECT_GT(number(status, "real_time_factor"), 0.0);
  EXPECT_GE(number(status, "behind_s"), 0.0);
  EXPECT_THAT(bleedctl({"status"}).output, AllOf(HasSubstr("instruments_malformed 1\n"), HasSubstr("force_expired     1\n"),
                                                 Not(HasSubstr("requests_refused"))));

  const Json watched = json({"watch", "--count", "1"});
  EXPECT_EQ(number(member(watched, "fault_counters"), "instruments_malformed"), 1.0);
  EXPECT_EQ(number(member(watched, "fault_counters"), "force_without_fluid"), missed);
  EXPECT_THAT(bleedctl({"watch", "--count", "1"}).output,
              AllOf(HasSubstr("instruments_malformed 1"), HasSubstr("force_expired 1")));

  const std::string file = fmt::format("{}/bleedsim_counted_{}.mcap", testing::TempDir(), getpid());
  ASSERT_EQ(bleedctl({"record", "-o", file, "--frames", "3"}).code, 0);
  EXPECT_EQ(number(member(json({"info", file}), "fault_counters"), "instruments_malformed"), 1.0);
  EXPECT_THAT(bleedctl({"info", file}).output, AllOf(HasSubstr("instruments_malformed 1\n"), HasSubstr("force_expired     1\n")));
  std::filesystem::remove(file);
}

TEST_F(BleedctlBleeddTest, WoundsAreAddedMovedChangedAndRemoved) {
  const Json added = json({"wound", "add", "--at", "-0.02,0,0", "--radius-mm", "3", "--flow-ml-per-s", "2", "--normal", "0,0,1"});
  EXPECT_EQ(text(added, "code"), "accepted");
  EXPECT_GT(number(added, "applied_step"), 0.0);
  const std::string id = std::to_string(static_cast<int>(number(added, "object_id")));
  EXPECT_EQ(id, "2");
  eventually([](const client::SessionStatus& status) { return status.wounds == 2; });

  EXPECT_EQ(text(json({"wound", "move", id, "--at", "-0.02,0.01,0"}), "code"), "accepted");
  EXPECT_EQ(text(json({"wound", "set", id, "--flow-ml-per-s", "0.5"}), "code"), "accepted");
  EXPECT_EQ(text(json({"wound", "set", id, "--pressure-mmhg", "0.3", "--name", "vein"}), "code"), "accepted");
  EXPECT_EQ(number(json({"wound", "set", "vein", "--flow-ml-per-s", "0.2"}), "object_id"), 2.0);
  EXPECT_EQ(text(json({"wound", "move", "vein", "--at", "-0.02,0,0"}), "code"), "accepted");
  const test::Finished artery = bleedctl({"wound", "remove", "artery"});
  EXPECT_EQ(artery.code, 1);
  EXPECT_THAT(artery.output, HasSubstr("there is no wound named 'artery'"));
  statusWhere([](const Json& status) {
    const auto& clients = member(status, "clients").list_value().values();
    return std::any_of(clients.begin(), clients.end(), [](const Json& client) { return number(client, "refused") == 1.0; });
  });
  EXPECT_THAT(bleedctl({"status"}).output, HasSubstr("1 requests (1 refused, 0 busy, 0 resent), 0 instrument samples"));
  const test::Finished removed = bleedctl({"wound", "remove", "vein"});
  EXPECT_EQ(removed.code, 0);
  EXPECT_THAT(removed.output, HasSubstr("wound 2"));
  eventually([](const client::SessionStatus& status) { return status.wounds == 1; });
}

TEST_F(BleedctlBleeddTest, ARefusalHasCodeOneAndLeavesTheSessionAsItWas) {
  const test::Finished unknown = bleedctl({"wound", "remove", "99"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.output, HasSubstr("99"));
  const test::Finished as_json = bleedctl({"wound", "move", "99", "--at", "0,0,0", "--json"}, false);
  EXPECT_EQ(as_json.code, 1);
  EXPECT_EQ(text(parseJson(as_json.output), "code"), "not found");
  EXPECT_FALSE(member(parseJson(as_json.output), "accepted").bool_value());

  const test::Finished outside = bleedctl({"wound", "add", "--at", "5,0,0", "--radius-mm", "2", "--flow-ml-per-s", "1"});
  EXPECT_EQ(outside.code, 1);
  EXPECT_THAT(outside.output, HasSubstr("domain"));
  const test::Finished stepped = bleedctl({"step", "5"});
  EXPECT_EQ(stepped.code, 1);
  EXPECT_THAT(stepped.output, HasSubstr("pause"));
  const test::Finished too_fast = bleedctl({"pace", "1e9"});
  EXPECT_EQ(too_fast.code, 2) << "the command line knows the range of a pace";
  const auto counted = [](const Json& status) { return number(member(status, "counters"), "requests_refused") >= 4.0; };
  const Json status = statusWhere(counted);
  EXPECT_EQ(number(status, "wounds"), 1.0);
  EXPECT_EQ(text(status, "pace"), "realtime");
  EXPECT_EQ(text(status, "state"), "running");
}

TEST_F(BleedctlBleeddTest, TheClockObeys) {
  EXPECT_EQ(text(json({"pause"}), "code"), "accepted");
  const auto still = eventually([](const client::SessionStatus& s) { return s.state == client::SessionState::paused; });
  // The first step that knew of the request is the one after those done.
  EXPECT_EQ(number(json({"step", "25"}), "applied_step"), static_cast<double>(still.step + 1));
  eventually([&](const client::SessionStatus& s) { return s.step == still.step + 25; });
  EXPECT_EQ(text(json({"resume"}), "code"), "accepted");
  eventually(
      [&](const client::SessionStatus& s) { return s.state == client::SessionState::running && s.step > still.step + 25; });
  for (const char* pace : {"0.5", "max", "realtime"}) {
    EXPECT_EQ(bleedctl({"pace", pace}).code, 0) << pace;
    statusWhere([&](const Json& status) { return text(status, "pace") == pace; });
  }
  EXPECT_EQ(
      text(json({"force", "--at", "0,0,0.002", "--radius-mm", "10", "--newtons", "0,0,-0.05", "--duration", "0.05"}), "code"),
      "accepted");
}

TEST_F(BleedctlBleeddTest, EffectsAreListedAndSwitched) {
  const auto find = [](const Json& list, const std::string& name) {
    for (const Json& row : list.list_value().values()) {
      if (text(row, "name") == name) return row;
    }
    ADD_FAILURE() << name << " is not in " << list.ShortDebugString();
    return Json{};
  };
  const Json before = json({"effect", "list"});
  EXPECT_EQ(text(find(before, "viscosity"), "state"), "on");
  EXPECT_THAT(text(find(before, "viscosity"), "settings"), HasSubstr("viscosity_pa_s: 0.00345"));
  EXPECT_EQ(text(find(before, "repulsion"), "state"), "off");
  EXPECT_THAT(bleedctl({"effect", "list"}).output, HasSubstr("on       viscosity       viscosity_pa_s: 0.00345"));

  const Json on = json({"effect", "on", "viscosity", "--set", "viscosity_pa_s: 0.01", "--set", "solve: EXPLICIT"});
  EXPECT_EQ(text(on, "code"), "accepted");
  EXPECT_GT(number(on, "applied_step"), 0.0);
  EXPECT_THAT(text(find(json({"effect", "list"}), "viscosity"), "settings"), HasSubstr("viscosity_pa_s: 0.01 solve: EXPLICIT"));
  EXPECT_THAT(bleedctl({"effect", "off", "viscosity"}).output, HasSubstr("viscosity is off at step"));
  EXPECT_EQ(text(find(json({"effect", "list"}), "viscosity"), "state"), "off");

  const test::Finished unknown = bleedctl({"effect", "on", "stickiness"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.output, HasSubstr("no such effect, use gravity"));
  const test::Finished bad = bleedctl({"effect", "on", "repulsion", "--set", "strength: 99"});
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.output, HasSubstr("effects.repulsion.strength: value 99 is out of range, allowed 0 to 10"));
  const test::Finished illegal = bleedctl({"effect", "on", "platelets"});
  EXPECT_EQ(illegal.code, 1);
  EXPECT_THAT(illegal.output, HasSubstr("needs viscosity"));
}

TEST_F(BleedctlBleeddTest, WatchGoesOnShowingAPausedSession) {
  EXPECT_EQ(text(json({"pause"}), "code"), "accepted");
  const auto still = eventually([](const client::SessionStatus& s) { return s.state == client::SessionState::paused; });
  const test::Finished watched = bleedctl({"watch", "--count", "2", "--json"}, false);
  ASSERT_EQ(watched.code, 0) << watched.output;
  std::istringstream lines{watched.output};
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const Json shown = parseJson(line);
    EXPECT_EQ(text(shown, "state"), "paused");
    EXPECT_EQ(number(shown, "step"), static_cast<double>(still.step));
    EXPECT_EQ(number(shown, "sim_time_s"), still.sim_time_s);
    EXPECT_EQ(number(shown, "particles"), static_cast<double>(still.particles));
  }
  EXPECT_EQ(count, 2);
}

TEST_F(BleedctlBleeddTest, ResetLoadAndShutdown) {
  const std::uint32_t epoch = daemon_->session().status()->epoch;
  const Json reset = json({"reset"});
  EXPECT_EQ(number(reset, "epoch"), epoch + 1.0);

  const std::string drip = kScenes + "drip.textproto";
  EXPECT_EQ(number(json({"load", drip}), "epoch"), epoch + 2.0);
  statusWhere([](const Json& status) { return text(member(status, "scene"), "name") == "drip"; });

  EXPECT_EQ(bleedctl({"load", kScenes + "missing.textproto"}).code, 4);
  const test::Finished folder = bleedctl({"load", kScenes});
  EXPECT_EQ(folder.code, 4);
  EXPECT_THAT(folder.output, HasSubstr("folder"));
  const test::Finished no_scene = bleedctl({"load", SCENE_DIR "/../debian-packages.txt"});
  EXPECT_EQ(no_scene.code, 1);
  EXPECT_THAT(no_scene.output, HasSubstr("--check"));
  EXPECT_EQ(text(member(json({"status"}), "scene"), "name"), "drip");

  const test::Finished ended = bleedctl({"shutdown"});
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(daemon_->process().wait(), 0) << daemon_->process().output();
  EXPECT_EQ(bleedctl({"status", "--timeout", "1"}).code, 3);
}

TEST_F(BleedctlBleeddTest, WrongUseHasCodeTwoAndReachesNobody) {
  EXPECT_EQ(bleedctl({"pause", "--fast"}).code, 2);
  EXPECT_EQ(bleedctl({"wound", "remove", ""}).code, 2);
  EXPECT_EQ(bleedctl({"wound", "move", "1", "--at", "1,2"}).code, 2);
  EXPECT_EQ(bleedctl({"pause", "--session", "no such name"}).code, 2);
  EXPECT_EQ(bleedctl({"pause", "--interface", "none0"}).code, 2);
  EXPECT_EQ(bleedctl({"pause", "--session", "other", "--timeout", "1"}).code, 3);
  const Json status = json({"status"});
  EXPECT_EQ(text(status, "state"), "running");
  EXPECT_EQ(number(member(status, "counters"), "requests"), 0.0);
}

}  // namespace
}  // namespace bleedsim::client_test
