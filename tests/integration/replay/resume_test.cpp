// kill -9 and --resume: what goes on is what would have been, and damage costs one checkpoint, not the session.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <gmock/gmock.h>
#include <map>
#include <mutex>
#include <optional>
#include <random>

#include "service/scene/scene.h"
#include "service/sph/world.h"
#include "tests/integration/replay/replay_fixture.h"

namespace bleedsim::replay_test {
namespace {

using testing::HasSubstr;

/// Of the service's own checkpoints, simulated s. At this test's pace 1 s, which is longer than a disk takes.
constexpr double kInterval = 0.02;

/// A run that nobody disturbs: the scene from its beginning, with the wound 'cut' moved after so many steps.
class UndisturbedRun {
 public:
  UndisturbedRun(const std::string& scene_text, std::optional<std::uint64_t> moved_after, const sph::Vec3& position)
      : moved_after_{moved_after}, position_{position} {
    const Result<scene::SceneDescription> scene = scene::parseScene(scene_text);
    auto world = sph::createWorld(scene->world, {});
    world_ = std::move(*world);
  }

  /// Of the state after so many steps; never fewer than before.
  std::uint64_t hashAt(std::uint64_t step) {
    while (world_->stepCount() < step) {
      if (moved_after_ == world_->stepCount()) {
        sph::UpdateWound moved;
        moved.wound_id = 1;
        moved.position = position_;
        EXPECT_TRUE(world_->apply(moved).ok());
      }
      EXPECT_TRUE(world_->step(std::numeric_limits<double>::infinity()).ok());
    }
    return world_->stateHash();
  }

 private:
  std::optional<std::uint64_t> moved_after_;
  sph::Vec3 position_;
  std::unique_ptr<sph::World> world_;
};

class Resume : public ReplayFixture {
 protected:
  /// Slow, so that an undisturbed run can follow, however the program was built.
  std::vector<std::string> options(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--pace", "0.02", "--checkpoint-every", std::to_string(kInterval), "--checkpoint-dir",
                             checkpointDir(), "--resume"});
    return more;
  }
  std::filesystem::path fileOf(const std::string& name) const {
    return std::filesystem::path{checkpointDir()} / session_ / (name + ".bleedstate");
  }

  /// The newest checkpoint that the session tells of, once there are `count` of them.
  static client::CheckpointInfo waitCheckpoints(client::Session& session, std::size_t count) {
    const auto enough = [count](const client::SessionStatus& status) { return status.checkpoints.size() >= count; };
    const auto status = session.waitStatus(enough, test::kPatience);
    EXPECT_TRUE(status.ok()) << status.status().message();
    return status.ok() ? status->checkpoints.front() : client::CheckpointInfo{};
  }

  /// s, of the state that it went on from, to the millisecond of the log.
  static double resumedTime(client_test::RunningDaemon& daemon) {
    EXPECT_TRUE(daemon.process().waitForOutput(" s of epoch "));
    const std::string& output = daemon.process().output();
    const std::size_t step = output.find("': step ", output.find("resumed from checkpoint '"));
    if (step == std::string::npos) return 0.0;
    return std::stod(output.substr(output.find(", ", step) + 2));
  }

  static void kill(client_test::RunningDaemon& daemon) {
    daemon.process().signal(SIGKILL);
    EXPECT_EQ(daemon.process().wait(), 128 + SIGKILL);
  }

  /// Later states of a session by their steps.
  static std::map<std::uint64_t, std::uint64_t> hashesOf(client_test::RunningDaemon& daemon, std::size_t count) {
    std::map<std::uint64_t, std::uint64_t> hashes;
    while (hashes.size() < count) {
      const auto stats = daemon.session().stats();
      if (stats) hashes[stats->step] = stats->state_hash;
      const std::uint64_t heartbeat = daemon.session().status()->heartbeat;
      const auto next = [&](const client::SessionStatus& status) { return status.heartbeat > heartbeat; };
      EXPECT_TRUE(daemon.session().waitStatus(next, test::kPatience).ok());
    }
    return hashes;
  }
};

TEST_F(Resume, AfterKillsAtRandomTimesGoesOnAsIfNothingHadHappened) {
  const auto seed = static_cast<unsigned>(std::time(nullptr));
  SCOPED_TRACE(fmt::format("seed {}", seed));
  std::mt19937 random{seed};
  auto daemon = start(options());
  ASSERT_NE(daemon, nullptr);
  // One input, safe in a checkpoint before the first kill.
  const sph::Vec3 position{0.002, -0.001, 0.0};
  const client::Reply moved = daemon->session().updateWound("cut", {.position = client::Vec3{0.002, -0.001, 0.0}}).get();
  ASSERT_TRUE(moved.accepted()) << moved.reason;
  ASSERT_TRUE(daemon->session().checkpoint("moved").get().accepted());
  waitCheckpoints(daemon->session(), 1);  // the list comes on another topic than the reply
  UndisturbedRun twin{sceneText(), moved.applied_step - 1, position};
  std::uint64_t before = 0;
  for (int round = 0; round < 3; ++round) {
    // By then the checkpoint that an epoch begins with is older than an interval: only one of the clock's own will do. The newest
    // is within an interval of what the session tells whenever its file took less than an interval to write. A slow disk may miss
    // one such moment, not all of them; a session that has stopped writing has none.
    const double reach = daemon->session().status()->sim_time_s + kInterval * (1.5 + 0.01 * static_cast<double>(random() % 200));
    const auto there = [reach](const client::SessionStatus& status) {
      return status.sim_time_s >= reach && !status.checkpoints.empty() &&
             status.sim_time_s - status.checkpoints.front().sim_time_s <= kInterval;
    };
    const auto seen = daemon->session().waitStatus(there, test::kPatience);
    ASSERT_TRUE(seen.ok()) << "no checkpoint of the last interval: " << seen.status().message();
    kill(*daemon);
    daemon = start(options());
    ASSERT_NE(daemon, nullptr);
    ASSERT_TRUE(daemon->process().waitForOutput("resumed from checkpoint '"));
    // One interval is lost at most, of what had been told to be safe; what ran while the last file was in flight depends on the
    // disk.
    const double resumed_time = resumedTime(*daemon) + 0.0005;  // the log rounds
    EXPECT_GE(resumed_time, seen->sim_time_s - kInterval);
    // A file that the session told of is on the disk: nothing before it is lost.
    const std::uint64_t resumed = daemon->session().status()->checkpoints.front().step;
    EXPECT_GE(daemon->session().status()->step, seen->checkpoints.front().step);
    EXPECT_GE(resumed, before);
    before = resumed;
  }
  for (const auto& [step, hash] : hashesOf(*daemon, 3)) EXPECT_EQ(hash, twin.hashAt(step)) << "step " << step;
  ASSERT_TRUE(daemon->session().shutdown().get().accepted());
  EXPECT_EQ(daemon->process().wait(), 0);
}

TEST_F(Resume, UsesTheOneBeforeWhereTheNewestIsDamaged) {
  // None of the clock's own among them: one that is due could come between the two.
  auto daemon = start({"--pace", "max", "--checkpoint-dir", checkpointDir()});
  ASSERT_NE(daemon, nullptr);
  ASSERT_TRUE(daemon->session().checkpoint("older").get().accepted());
  ASSERT_TRUE(daemon->session().pause().get().accepted());
  ASSERT_TRUE(daemon->session().checkpoint("good").get().accepted());
  ASSERT_TRUE(daemon->session().checkpoint("bad").get().accepted());
  kill(*daemon);
  std::string bytes;
  {
    std::ifstream in{fileOf("bad"), std::ios::binary};
    bytes.assign(std::istreambuf_iterator<char>{in}, {});
  }
  ASSERT_GT(bytes.size(), 1000u);
  bytes[bytes.size() - 100] = static_cast<char>(bytes[bytes.size() - 100] ^ 4);
  std::ofstream{fileOf("bad"), std::ios::binary} << bytes;
  std::ofstream{fileOf("empty"), std::ios::binary}.flush();

  test::ChildProcess again{{BLEEDD_PATH, "--scene", sceneFile(), "--session", session_, "--domain", std::to_string(kDomain),
                            "--pace", "max", "--checkpoint-dir", checkpointDir(), "--resume"},
                           true};
  EXPECT_TRUE(again.waitForOutput("skipped checkpoint 'bad': its state is damaged: the checksum is another"));
  EXPECT_TRUE(again.waitForOutput("resumed from checkpoint 'good'"));
  EXPECT_TRUE(again.waitForOutput(", paused")) << "it was in a pause";
  again.signal(SIGTERM);
  EXPECT_EQ(again.wait(), 0) << again.output();
}

TEST_F(Resume, ItsDurationIsThatOfTheSessionBeforeAndAfterTheKill) {
  auto daemon = start(options());
  ASSERT_NE(daemon, nullptr);
  waitCheckpoints(daemon->session(), 2);
  kill(*daemon);
  const double until = daemon->session().status()->sim_time_s + 0.2;
  daemon = start(options({"--duration", std::to_string(until)}));
  ASSERT_NE(daemon, nullptr);
  EXPECT_EQ(daemon->process().wait(), 0);
  // The option's text has six decimals, and a step is far shorter than 10 ms.
  const auto over_there = [until](const client::SessionStatus& status) { return status.sim_time_s >= until - 1e-6; };
  const auto end = daemon->session().waitStatus(over_there, test::kPatience);
  ASSERT_TRUE(end.ok()) << end.status().message();
  EXPECT_LT(end->sim_time_s, until + 0.01);

  test::ChildProcess over{{BLEEDD_PATH, "--scene", sceneFile(), "--session", session_, "--domain", std::to_string(kDomain),
                           "--checkpoint-dir", checkpointDir(), "--resume", "--duration", "0.001"},
                          true};
  EXPECT_EQ(over.wait(), 0) << over.output();
  EXPECT_THAT(over.output(), HasSubstr("nothing is left to run: --duration is 0.001 s"));
}

TEST_F(Resume, StartsTheSceneWhereThereIsNothingToResumeFrom) {
  const auto daemon = start(options());
  ASSERT_NE(daemon, nullptr);
  EXPECT_TRUE(daemon->process().waitForOutput("nothing to resume from in '"));
  EXPECT_EQ(daemon->session().status()->epoch, 1u);
  ASSERT_TRUE(daemon->session().shutdown().get().accepted());
}

TEST_F(Resume, CheckpointsByRequestAndCommandLine) {
  const auto daemon = start({"--checkpoint-dir", checkpointDir()});
  ASSERT_NE(daemon, nullptr);
  const auto bleedctl = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {BLEEDCTL_PATH, "--domain", std::to_string(kDomain), "--session", session_});
    return test::runProcess(arguments, true);
  };
  const test::Finished none = bleedctl({"checkpoints"});
  EXPECT_EQ(none.code, 0);
  EXPECT_THAT(none.output, HasSubstr("has no checkpoints"));
  EXPECT_THAT(bleedctl({"restore", "other"}).output, HasSubstr("there is no checkpoint 'other'"));
  const test::Finished kept = bleedctl({"checkpoint", "first"});
  EXPECT_EQ(kept.code, 0) << kept.output;
  EXPECT_THAT(kept.output, HasSubstr("checkpoint 'first' kept"));
  waitCheckpoints(daemon->session(), 1);
  EXPECT_THAT(bleedctl({"checkpoints"}).output, HasSubstr("first"));
  EXPECT_THAT(bleedctl({"checkpoints", "--json"}).output, HasSubstr("\"name\": \"first\""));
  const test::Finished back = bleedctl({"restore", "first"});
  EXPECT_EQ(back.code, 0) << back.output;
  EXPECT_THAT(back.output, HasSubstr("returned to checkpoint 'first'"));
  EXPECT_THAT(bleedctl({"checkpoint", "../escape"}).output, HasSubstr("use 1 to 48 letters"));
  EXPECT_EQ(bleedctl({"checkpoint", "../escape"}).code, 2);
  EXPECT_THAT(daemon->session().checkpoint("auto-1").get().reason, HasSubstr("the service's own"));
  const client::Reply named = daemon->session().checkpoint().get();
  EXPECT_TRUE(named.accepted()) << named.reason;
  EXPECT_EQ(named.object_name, "auto-00000002");
  ASSERT_TRUE(daemon->session().shutdown().get().accepted());
}

TEST_F(Resume, WithoutAFolderTellsHowToGetOne) {
  const auto daemon = start({});
  ASSERT_NE(daemon, nullptr);
  for (const client::Reply& reply : {daemon->session().checkpoint("a").get(), daemon->session().restore("a").get()}) {
    EXPECT_EQ(reply.code, client::ReplyCode::wrong_state);
    EXPECT_THAT(reply.reason, HasSubstr("start it with --checkpoint-every or --checkpoint-dir"));
  }
  ASSERT_TRUE(daemon->session().shutdown().get().accepted());
}

}  // namespace
}  // namespace bleedsim::replay_test
