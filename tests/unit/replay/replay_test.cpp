// A recorded run simulated again: bit-equal, whatever was asked of the session, or refused with the reason.
#include "service/replay/replay.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/build/build_info.h"
#include "service/checkpoint/state_file.h"
#include "service/recording/convert.h"
#include "service/recording/recording_reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/replay/live_run.h"

namespace bleedsim::replay {
namespace {

using testing::HasSubstr;

class Replay : public testing::Test {
 protected:
  Replay() {
    Result<checkpoint::Folder> folder = checkpoint::Folder::open(scratch_.path() / "checkpoints");
    if (!folder) throw std::runtime_error{folder.status().message()};
    checkpoints_ = std::make_shared<checkpoint::Folder>(std::move(*folder));
  }

  std::filesystem::path file(const char* name = "run.mcap") const { return scratch_.path() / name; }

  RecordedRun read(const char* name = "run.mcap") const {
    Result<RecordedRun> run = readRun(file(name));
    EXPECT_TRUE(run.ok()) << run.status().message();
    return run.ok() ? std::move(*run) : RecordedRun{};
  }

  static std::string problemOf(const Result<ReplayReport>& report) {
    if (!report) return report.status().message();
    for (const EpochReplay& epoch : report->epochs) {
      if (!epoch.broken.empty()) return epoch.broken;
      if (epoch.difference) return fmt::format("step {} differs", epoch.difference->recorded.step);
    }
    return {};
  }

  static void expectBitEqual(const RecordedRun& run, const ReplayOptions& options, std::size_t epochs) {
    const Result<ReplayReport> report = replayRun(run, options);
    ASSERT_EQ(problemOf(report), "");
    EXPECT_TRUE(report->bitEqual());
    ASSERT_EQ(report->epochs.size(), epochs);
    for (const EpochReplay& epoch : report->epochs) EXPECT_GT(epoch.compared, 5u) << "epoch " << epoch.epoch;
  }

  /// Wounds, forces, tools and an effect that is switched, from the state at hand on.
  static void disturb(LiveRun& run) {
    run.steps(25);
    run.pushTool(1, 0.002);
    run.steps(10);
    client::WoundSpec wound;
    wound.name = std::string{"second"};
    wound.position = {0.012, 0.0, 0.0};
    wound.radius_m = 0.003;
    wound.flow_ml_per_s = 2.0;
    const dds::Reply added = run.ask(client::buildAddWound(wound));
    ASSERT_EQ(added.code, dds::ReplyCode::accepted) << added.reason;
    run.pushTool(2, -0.001);
    run.steps(20);
    run.pushTool(1, 0.001);
    ASSERT_EQ(run.ask(client::buildForce({{0.0, 0.0, 0.004}, 0.005, {0.0, 0.002, 0.0}, 0.004})).code, dds::ReplyCode::accepted);
    ASSERT_EQ(run.ask(client::buildUpdateWound("cut", {.position = client::Vec3{-0.002, 0.001, 0.0}})).code,
              dds::ReplyCode::accepted);
    run.steps(15);
    const dds::Reply switched = run.ask(client::buildEffect("platelets", true, "clot_speedup: 50"));
    ASSERT_EQ(switched.code, dds::ReplyCode::accepted) << switched.reason;
    run.steps(20);
    run.loseTools();
    run.steps(10);
    ASSERT_EQ(run.ask(client::buildRemoveWound("second")).code, dds::ReplyCode::accepted);
    ASSERT_EQ(run.ask(client::buildEffect("viscosity", true, "viscosity_pa_s: 0.01")).code, dds::ReplyCode::accepted);
    run.steps(20);
  }

  test::TemporaryFolder scratch_;
  std::shared_ptr<checkpoint::Folder> checkpoints_;
};

TEST_F(Replay, OfCommandsToolsAndSwitchedEffectsIsBitEqual) {
  LiveRun live{liveScene(), file(), checkpoints_};
  disturb(live);
  const dds::Reply reset = live.ask(client::buildPlain(bleed_v1_REQUEST_RESET));
  ASSERT_EQ(reset.code, dds::ReplyCode::accepted) << reset.reason;
  disturb(live);
  live.close();
  const RecordedRun run = read();
  EXPECT_EQ(run.not_replayable, "");
  expectBitEqual(run, {.verify = true}, 2);
  expectBitEqual(run, {.threads = 2, .verify = true}, 2);
}

TEST_F(Replay, FindsTheWorldThatAnAutomaticDecisionMade) {
  LiveRun live{liveScene("surface_tension {} auto: 'surface_tension'"), file(), checkpoints_};
  live.steps(30);
  // Narrow enough to need the tension that was left out.
  client::WoundSpec narrow;
  narrow.position = {0.012, 0.0, 0.0};
  narrow.shape = client::WoundShape::polyline;
  narrow.outline = {-0.004, 0.0, 0.004, 0.0};
  narrow.width_m = 0.002;
  narrow.flow_ml_per_s = 1.0;
  const dds::Reply added = live.ask(client::buildAddWound(narrow));
  ASSERT_EQ(added.code, dds::ReplyCode::accepted) << added.reason;
  live.steps(40);
  live.close();
  const RecordedRun run = read();
  std::size_t switched = 0;
  for (const recording::Journal& entry : run.epochs.at(1).journal) switched += entry.has_switched() ? 1 : 0;
  ASSERT_EQ(switched, 1u) << "the scene has tension from the start";
  expectBitEqual(run, {.verify = true}, 1);
}

TEST_F(Replay, GoesThroughARewind) {
  LiveRun live{liveScene(), file(), checkpoints_};
  disturb(live);
  live.pushTool(1, 0.003);
  live.steps(3);
  const dds::Reply kept = live.ask(client::buildCheckpoint("here"));
  ASSERT_EQ(kept.code, dds::ReplyCode::accepted) << kept.reason;
  EXPECT_EQ(kept.object_name, "here");
  live.steps(40);
  const dds::Reply back = live.ask(client::buildRestore("here"));
  ASSERT_EQ(back.code, dds::ReplyCode::accepted) << back.reason;
  EXPECT_EQ(back.object_name, "here");
  EXPECT_EQ(live.simulation().epoch(), 2u);
  disturb(live);  // by its name, the moved wound is still known
  live.close();
  const RecordedRun run = read();
  EXPECT_EQ(run.not_replayable, "");
  const recording::Restored* restored = run.epochs.at(2).restored();
  ASSERT_NE(restored, nullptr);
  EXPECT_EQ(restored->name(), "here");
  EXPECT_EQ(restored->epoch(), 1u);
  expectBitEqual(run, {.verify = true}, 2);
  expectBitEqual(run, {.threads = 2, .verify = true}, 2);
}

TEST_F(Replay, OfAResumedSessionNeedsItsCheckpoint) {
  std::uint64_t step = 0;
  {
    LiveRun killed{liveScene(), file("killed.mcap"), checkpoints_};
    disturb(killed);
    killed.pushTool(3, 0.002);
    killed.steps(4);
    ASSERT_EQ(killed.ask(client::buildCheckpoint("last")).code, dds::ReplyCode::accepted);
    step = killed.world().stepCount();
  }
  const std::filesystem::path saved = checkpoints_->path() / "last.bleedstate";
  const Result<checkpoint::Checkpoint> checkpoint = checkpoint::readCheckpoint(saved);
  ASSERT_TRUE(checkpoint.ok()) << checkpoint.status().message();
  EXPECT_LE(checkpoint->head.mark.step, step);
  EXPECT_EQ(checkpoint->head.mark.tool_count, 1u);
  LiveRun resumed{"", file("resumed.mcap"), checkpoints_, {.session = 8}};
  EXPECT_EQ(resumed.world().stepCount(), checkpoint->head.mark.step);
  EXPECT_EQ(resumed.world().stateHash(), checkpoint->head.mark.state_hash);
  resumed.steps(60);
  resumed.close();
  const RecordedRun run = read("resumed.mcap");
  EXPECT_THAT(problemOf(replayRun(run, {.verify = true})), HasSubstr("a checkpoint of another session"));
  EXPECT_THAT(problemOf(replayRun(run, {})), HasSubstr("give it with --checkpoint"));
  ReplayOptions options{.verify = true};
  options.checkpoint = *checkpoint;
  expectBitEqual(run, options, 1);
  options.checkpoint->head.mark.state_hash ^= 1;
  EXPECT_THAT(problemOf(replayRun(run, options)), HasSubstr("is not the one that it begins with"));
}

TEST_F(Replay, TellsTheFirstStepThatDiffers) {
  LiveRun live{liveScene(), file(), checkpoints_};
  live.steps(40);
  live.pushTool(1, 0.002);
  live.steps(60);
  live.close();
  RecordedRun run = read();
  recording::Journal& entry = run.epochs.at(1).journal.back();
  ASSERT_TRUE(entry.has_instrument());
  entry.mutable_instrument()->mutable_force()->set_x(0.0021);
  const Result<ReplayReport> report = replayRun(run, {.verify = true});
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_FALSE(report->bitEqual());
  const EpochReplay& epoch = report->epochs.front();
  ASSERT_TRUE(epoch.difference.has_value());
  // The first recorded state after the changed input.
  for (const RecordedState& state : run.epochs.at(1).states) {
    if (state.step <= entry.step()) continue;
    EXPECT_EQ(epoch.difference->recorded.step, state.step);
    break;
  }
  EXPECT_GT(epoch.equal, 0u);
  EXPECT_LT(epoch.equal, epoch.compared);
  // What comes before may be left out.
  const Result<ReplayReport> later = replayRun(run, {.from_step = entry.step() + 1});
  ASSERT_TRUE(later.ok());
  EXPECT_EQ(later->epochs.front().equal, 0u);
}

TEST_F(Replay, RefusesWhatItCannotPromise) {
  LiveRun live{liveScene(), file(), checkpoints_};
  live.steps(20);
  ASSERT_EQ(live.ask(client::buildForce({{0.0, 0.0, 0.004}, 0.005, {0.0, 0.002, 0.0}, 0.004})).code, dds::ReplyCode::accepted);
  live.steps(30);
  live.close();
  const RecordedRun run = read();
  const auto refusal = [&](const std::function<void(RecordedRun&)>& change, const ReplayOptions& options = {.verify = true}) {
    RecordedRun changed = run;
    change(changed);
    return problemOf(replayRun(changed, options));
  };
  EXPECT_EQ(refusal([](RecordedRun&) {}), "");
  EXPECT_THAT(refusal([](RecordedRun& r) { r.build_id = std::string{"9.9 other"}; }),
              HasSubstr("made by build '9.9 other', this is '" + buildId()));
  EXPECT_THAT(refusal([](RecordedRun& r) { r.simd_target = std::string{"sve"}; }), HasSubstr("SIMD target 'sve'"));
  EXPECT_THAT(refusal([](RecordedRun&) {},
                      {.simd = run.simd_target == "scalar" ? sph::SimdTarget::avx2 : sph::SimdTarget::scalar, .verify = true}),
              HasSubstr("SIMD target"));
  EXPECT_THAT(refusal([](RecordedRun& r) { r.precision = std::string{"float16"}; }), HasSubstr("its precision is 'float16'"));
  EXPECT_THAT(refusal([](RecordedRun& r) { r.not_replayable = std::string{"2 journal entries of epoch 1 are missing"}; }),
              HasSubstr("2 journal entries"));
  EXPECT_THAT(refusal([](RecordedRun& r) { r.epochs.at(1).scene_text.clear(); }), HasSubstr("its scene is not in the file"));
  EXPECT_THAT(refusal([](RecordedRun& r) { r.epochs.at(1).states.clear(); }), HasSubstr("no statistics of frames"));
  // A comparison of nothing is none.
  const std::uint64_t last = run.epochs.at(1).states.back().step;
  EXPECT_EQ(refusal([](RecordedRun&) {}, {.verify = true, .from_step = last}), "");
  EXPECT_EQ(refusal([](RecordedRun&) {}, {.verify = true, .from_step = last + 1}),
            fmt::format("it has no state from step {} on to compare; its last one is of step {}", last + 1, last));
  const Result<ReplayReport> nothing = replayRun(run, {.from_step = last + 1});
  ASSERT_TRUE(nothing.ok()) << nothing.status().message();
  EXPECT_EQ(nothing->epochs.front().compared, 0u);
  EXPECT_FALSE(nothing->bitEqual());
  // Without --verify another build is no more than a doubt.
  EXPECT_EQ(refusal([](RecordedRun& r) { r.build_id = std::string{"9.9 other"}; }, {}), "");
}

TEST_F(Replay, AGapInTheJournalIsNoticed) {
  LiveRun live{liveScene(), file(), checkpoints_};
  live.steps(20);
  live.pushTool(1, 0.002);
  live.steps(10);
  live.close();
  // The last entry of the journal is not there, as in a file that was cut off: only the states can tell.
  Result<recording::RecordingReader> reader = recording::RecordingReader::open(file());
  ASSERT_TRUE(reader.ok());
  auto writer = recording::RecordingWriter::open(file("cut.mcap"));
  ASSERT_TRUE(writer.ok());
  for (recording::RecordedMessage message; *reader->next(message);) {
    recording::Scene scene;
    recording::Frame frame;
    recording::FrameStats stats;
    if (message.topic == recording::Topic::scene && recording::decode(message, scene)) {
      ASSERT_TRUE(writer->append(**recording::fromRecording(scene), 1).ok());
    } else if (message.topic == recording::Topic::frame && recording::decode(message, frame)) {
      ASSERT_TRUE(writer->append(**recording::fromRecording(frame), 1).ok());
    } else if (message.topic == recording::Topic::frame_stats && recording::decode(message, stats)) {
      ASSERT_TRUE(writer->append(**recording::fromRecording(stats), 1).ok());
    }
  }
  ASSERT_TRUE(writer->close().ok());
  EXPECT_THAT(problemOf(replayRun(read("cut.mcap"), {.verify = true})), HasSubstr("journal entries of epoch 1 are missing"));
}

TEST_F(Replay, ChecksEveryStateOnlyAfterItsInputs) {
  LiveRun live{liveScene(), file(), checkpoints_, {.checkpoint_every = 0.01}};
  disturb(live);
  live.awaitCheckpoints(2);
  live.close();
  std::vector<std::uint64_t> seen;
  ReplayOptions options{.verify = true};
  options.seen = [&seen](const RecordedState& state) { seen.push_back(state.seq); };
  const RecordedRun run = read();
  expectBitEqual(run, options, 1);
  EXPECT_EQ(seen.size(), run.epochs.at(1).states.size());
  EXPECT_GE(checkpoints_->list().size(), 2u);
  EXPECT_LE(checkpoints_->list().size(), checkpoint::Folder::kAutomaticKept);
}

}  // namespace
}  // namespace bleedsim::replay
