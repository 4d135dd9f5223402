#include "tests/unit/replay/live_run.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "service/build/build_info.h"
#include "service/dds/decode.h"

namespace bleedsim::replay {
namespace {

constexpr std::uint64_t kWriter = 5;
constexpr dds::Uuid kClient{9};

}  // namespace

std::string liveScene(const std::string& effects) {
  return "name: 'live'\n"
         "domain { lower_m { x: -0.03 y: -0.03 z: -0.012 } upper_m { x: 0.03 y: 0.03 z: 0.03 } capacity: 3000 }\n"
         "resolution { spacing_m: 0.002 }\n"
         "compressibility { design_speed_m_per_s: 0.5 max_fall_or_depth_m: 0.01 }\n"
         "effects { gravity { acceleration_m_per_s2 { z: -9.81 } } pressure {} viscosity {} applied_force {} " +
         effects +
         " }\n"
         "tissue { plane { normal { z: 1.0 } } }\n"
         "fluid_blocks { lower_m { x: -0.008 y: -0.008 z: 0 } upper_m { x: 0.008 y: 0.008 z: 0.008 } jitter: 0.2 }\n"
         "wounds { name: 'cut' disc { radius_m: 0.004 } flow_ml_per_s: 3 }\n"
         "output { frame_rate_hz: 1000 }\n";
}

LiveRun::LiveRun(const std::string& scene_text, const std::filesystem::path& file,
                 std::shared_ptr<checkpoint::Folder> checkpoints, const Options& options)
    : identity_{dds::Uuid{options.session}, "live", buildVersion(), buildId(), "host", 1, 1} {
  sph::WorldOptions world;
  world.threads = options.threads;
  const daemon::SceneFactory factory = daemon::worldFactory(world, checkpoints);
  daemon::SceneJob job;
  job.text = scene_text;
  if (scene_text.empty()) job.checkpoint.emplace();
  Result<daemon::LoadedScene> loaded = factory(job);
  if (!loaded) throw std::runtime_error{loaded.status().message()};
  keeper_ = std::make_unique<daemon::CheckpointKeeper>(std::move(checkpoints),
                                                       daemon::CheckpointOrigin{buildId(), "live", identity_.uuid},
                                                       channels_.board, channels_.commands.wakeup(), channels_.publisher);
  frame_encoder_ = std::make_unique<dds::FrameEncoder>(identity_.uuid);
  stats_encoder_ = std::make_unique<dds::FrameStatsEncoder>(identity_.uuid);
  scene_encoder_ = std::make_unique<dds::SceneEncoder>(identity_);
  Result<recording::RecordingWriter> writer = recording::RecordingWriter::open(file);
  if (!writer) throw std::runtime_error{writer.status().message()};
  writer_.emplace(std::move(*writer));
  daemon::SimulationOptions simulation{{dds::PaceMode::maximum, 1.0}, {}, {}};
  simulation.keeper = keeper_.get();
  simulation.checkpoint_every = options.checkpoint_every;
  simulation_ = std::make_unique<daemon::Simulation>(simulation, std::move(*loaded), factory, channels_, now_);
  record();
}

void LiveRun::tick() {
  simulation_->tick(now_);
  record();
}

void LiveRun::steps(std::uint64_t count) {
  const std::uint64_t end = world().stepCount() + count;
  while (world().stepCount() < end) tick();
}

dds::Reply LiveRun::ask(const Result<client::RequestPointer>& request) {
  EXPECT_TRUE(request.ok());
  bleed_v1_Request& wire = (*request)->wire;
  wire.client[0] = kClient[0];
  wire.run = 1;
  wire.seq = ++request_seq_;
  Result<dds::Action> action = dds::decodeAction(wire.body);
  Result<std::string> wound_name = dds::decodeWoundName(wire.body);
  EXPECT_TRUE(action.ok() && wound_name.ok());
  EXPECT_TRUE(channels_.commands.tryPush(dds::DecodedRequest{dds::requestKey(wire), std::move(*action), std::move(*wound_name),
                                                             kWriter, kWriter, 0, std::make_unique<dds::RequestCopy>(wire)}));
  dds::Reply reply;
  for (;;) {
    tick();
    if (channels_.replies.tryPop(reply)) return reply;
    // A world is built or a file written: the session goes on meanwhile, as a live one does.
    if (simulation_->state() != dds::SessionState::running) channels_.commands.wakeup().wait({});
  }
}

void LiveRun::pushTool(std::uint32_t tool, double force_x) {
  bleed_v1_Instrument sample{};
  sample.client[0] = kClient[0];
  sample.tool = tool;
  sample.seq = ++sample_seq_;
  sample.position = {0.001 * tool, 0.0, 0.003};
  sample.orientation.w = 1.0;
  sample.tip_radius_m = 0.004;
  sample.force = {force_x, 0.0, 0.001};
  Result<dds::InstrumentSample> decoded = dds::decodeInstrument(sample);
  ASSERT_TRUE(decoded.ok()) << decoded.status().message();
  decoded->writer = kWriter;
  ASSERT_TRUE(channels_.commands.tryPush(daemon::InstrumentInput{std::move(*decoded), now_}));
}

void LiveRun::loseTools() { ASSERT_TRUE(channels_.commands.tryPush(daemon::WriterLost{kWriter})); }

void LiveRun::awaitCheckpoints(std::uint64_t count) {
  while (channels_.counters.value(daemon::ServiceCounter::checkpoints_written) < count) tick();
}

void LiveRun::record() {
  if (const auto scene = channels_.board.takeScene()) { ASSERT_TRUE(writer_->append(scene_encoder_->encode(*scene), 1).ok()); }
  if (const dds::FrameSnapshot* frame = channels_.frames.load()) {
    ++frame_seq_;
    ASSERT_TRUE(writer_->append(frame_encoder_->encode(*frame, frame_seq_), 1).ok());
    ASSERT_TRUE(writer_->append(stats_encoder_->encode(*frame, frame_seq_, 0, {}), 1).ok());
  }
  for (dds::JournalEntry entry; channels_.journal.tryPop(entry);) {
    ASSERT_TRUE(writer_->append(dds::encodeJournal(identity_.uuid, entry), 1).ok());
  }
}

void LiveRun::close() { ASSERT_TRUE(writer_->close().ok()); }

}  // namespace bleedsim::replay
