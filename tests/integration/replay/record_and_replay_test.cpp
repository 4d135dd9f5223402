// A session recorded over DDS while it is commanded and pushed, simulated again by bleedlab.
#include <algorithm>
#include <cstdint>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "bleedsim/recorder.h"
#include "tests/integration/replay/replay_fixture.h"

namespace bleedsim::replay_test {
namespace {

using testing::HasSubstr;

class RecordAndReplay : public ReplayFixture {
 protected:
  std::string sceneText() const override { return poolScene(0.016); }

  std::string file() const { return (folder_ / "run.mcap").string(); }

  static void expectAccepted(const client::Reply& reply) { EXPECT_TRUE(reply.accepted()) << reply.reason; }

  /// Waits until a state later by so many steps has come.
  static void passSteps(client::Session& session, std::uint64_t count) {
    const std::uint64_t from = session.status()->step;
    const auto passed = [&](const client::SessionStatus& status) { return status.step >= from + count; };
    EXPECT_TRUE(session.waitStatus(passed, test::kPatience).ok());
  }

  /// Waits until so many frames more are recorded: a slow machine makes many steps between two of them.
  static void passFrames(client::Session& session, const client::Recorder& recorder, std::uint64_t count) {
    const std::uint64_t enough = recorder.progress().frames + count;
    while (recorder.progress().frames < enough && !recorder.progress().done) passSteps(session, 1);
  }

  test::Finished replay(std::vector<std::string> more) const {
    more.insert(more.begin(), {BLEEDLAB_PATH, "replay", file()});
    return test::runProcess(more, true);
  }

  /// Steps of the states that --speed lets pass, in the order of its lines.
  static std::vector<std::uint64_t> stepsShown(const std::string& output) {
    std::vector<std::uint64_t> steps;
    std::istringstream lines{output};
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("step ", 0) == 0) steps.push_back(std::stoull(line.substr(5)));
    }
    return steps;
  }
};

TEST_F(RecordAndReplay, IsBitEqualOnOneThreadAndOnTwo) {
  const auto daemon = start({"--pace", "max", "--threads", "2", "--checkpoint-dir", checkpointDir()});
  ASSERT_NE(daemon, nullptr);
  client::Session& session = daemon->session();
  auto recorder = client::Recorder::start(daemon->client(), session_, file(), {});
  ASSERT_TRUE(recorder.ok()) << recorder.status().message();
  {
    auto tool = session.instrument(1, "PSM1");
    ASSERT_TRUE(tool.ok()) << tool.status().message();
    for (int k = 0; k < 20; ++k) {
      ASSERT_TRUE(
          tool->send({.position = {0.0005 * k, 0.0, 0.008}, .tip_radius_m = 0.005, .force = {0.003, 0.0, 0.0005 * k}}).ok());
    }
    passSteps(session, 20);
    client::WoundSpec wound{.name = "second", .position = {0.025, 0.0, 0.0}, .radius_m = 0.003, .flow_ml_per_s = 2.0};
    expectAccepted(session.addWound(wound).get());
    expectAccepted(session.updateWound("cut", {.position = client::Vec3{-0.002, 0.001, 0.0}}).get());
    expectAccepted(session.force({{0.0, 0.0, 0.01}, 0.006, {0.0, 0.004, 0.0}, 0.004}).get());
    expectAccepted(session.setEffect("platelets", true, "clot_speedup: 50").get());
    expectAccepted(session.checkpoint("here").get());
    passSteps(session, 20);
    passFrames(session, *recorder, 5);
  }  // the tool is lost
  expectAccepted(session.setEffect("platelets", false).get());
  expectAccepted(session.restore("here").get());
  expectAccepted(session.removeWound("second").get());
  expectAccepted(session.pause().get());
  expectAccepted(session.step(7).get());
  expectAccepted(session.resume().get());
  passSteps(session, 30);
  passFrames(session, *recorder, 5);
  expectAccepted(session.shutdown().get());
  ASSERT_TRUE(recorder->waitDone(test::kPatience));
  ASSERT_TRUE(recorder->close().ok());
  const test::Finished info = test::runProcess({BLEEDCTL_PATH, "info", file()}, false);
  EXPECT_EQ(info.code, 0) << info.output;

  std::vector<std::uint64_t> shown;
  for (const char* threads : {"1", "2"}) {
    const std::string json_file = (folder_ / "replay.json").string();
    // A pace far above that of the solver, so that nobody waits.
    const test::Finished verified = replay({"--verify", "--threads", threads, "--json", json_file, "--speed", "1000"});
    EXPECT_EQ(verified.code, 0) << verified.output;
    EXPECT_THAT(verified.output, HasSubstr("recorded states are bit-equal"));
    const nlohmann::json json = nlohmann::json::parse(std::ifstream{json_file});
    EXPECT_TRUE(json["bit_equal"].get<bool>());
    ASSERT_EQ(json["epochs"].size(), 2u);
    EXPECT_GT(json["epochs"][0]["inputs"].get<int>(), 5);
    EXPECT_GT(json["epochs"][0]["compared"].get<int>(), 3);
    EXPECT_GT(json["epochs"][1]["compared"].get<int>(), 3);
    shown = stepsShown(verified.output);
    EXPECT_EQ(shown.size(), json["epochs"][0]["compared"].get<std::size_t>() + json["epochs"][1]["compared"].get<std::size_t>());
  }
  ASSERT_FALSE(shown.empty());
  std::vector<std::uint64_t> sorted = shown;
  std::sort(sorted.begin(), sorted.end());
  const std::uint64_t middle = sorted[sorted.size() / 2];
  ASSERT_LT(sorted.front(), middle) << "nothing to leave out";
  std::vector<std::uint64_t> later;
  std::copy_if(shown.begin(), shown.end(), std::back_inserter(later), [middle](std::uint64_t step) { return step >= middle; });
  const test::Finished from = replay({"--verify", "--from", std::to_string(middle), "--speed", "1000"});
  EXPECT_EQ(from.code, 0) << from.output;
  EXPECT_EQ(stepsShown(from.output), later);

  const test::Finished beyond = replay({"--verify", "--from", std::to_string(sorted.back() + 1)});
  EXPECT_EQ(beyond.code, 3) << beyond.output;
  EXPECT_THAT(beyond.output,
              HasSubstr(fmt::format("cannot be verified: it has no state from step {} on to compare; its last one is of step {}",
                                    sorted.back() + 1, sorted.back())));
  EXPECT_EQ(replay({"--speed", "0"}).code, 2);
  const test::Finished other = replay({"--verify", "--simd", "scalar"});
  EXPECT_EQ(other.code, 3) << other.output;
  EXPECT_THAT(other.output, HasSubstr("cannot be verified: it was made with SIMD target"));
}

}  // namespace
}  // namespace bleedsim::replay_test
