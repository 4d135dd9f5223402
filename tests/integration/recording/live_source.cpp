#include "tests/integration/recording/live_source.h"

#include <array>
#include <chrono>
#include <cstring>
#include <random>
#include <string_view>
#include <utility>

namespace bleedsim::recording_test {

namespace {

constexpr double kFrameRateHz = 60.0;
constexpr std::size_t kBytesPerParticle = 28;  // 3 floats, an id, 3 floats
constexpr double kParticleMl = 0.027;

template <std::size_t N>
void setText(char (&to)[N], std::string_view from) {
  const std::size_t size = from.copy(to, N - 1);
  to[size] = '\0';
}

bleed_v1_RequestApplied woundAdded(std::uint64_t number) {
  bleed_v1_RequestApplied applied{};
  applied.object_id = static_cast<std::uint32_t>(number);
  applied.request.run = 77;
  applied.request.seq = number;
  applied.request.body._d = bleed_v1_REQUEST_WOUND_ADD;
  bleed_v1_Wound& wound = applied.request.body._u.wound_add;
  setText(wound.name, "second wound");
  wound.position = {0.01, -0.02, 0.0};
  wound.normal = {0.0, 0.0, 1.0};
  wound.shape = bleed_v1_SHAPE_DISC;
  wound.radius_m = 0.003;
  wound.drive = bleed_v1_DRIVE_FLOW;
  wound.flow_ml_per_s = 2.0;
  return applied;
}

bleed_v1_Instrument instrumentSample(std::uint64_t number) {
  bleed_v1_Instrument sample{};
  sample.tool = 3;
  sample.seq = number;
  setText(sample.name, "PSM1");
  sample.position = {0.1, 0.2, 0.3};
  sample.orientation.w = 1.0;
  sample.tip_radius_m = 0.005;
  sample.force = {0.0, 0.0, -0.25};
  return sample;
}

}  // namespace

FrameContent frameContent(std::uint64_t seq, std::uint32_t epoch, std::uint32_t count) {
  FrameContent content{
      .seq = seq, .epoch = epoch, .count = count, .sim_time_s = static_cast<double>(seq) / kFrameRateHz, .payload = {}};
  content.payload.resize(count * kBytesPerParticle);
  std::mt19937_64 random{seq * 31 + epoch};
  for (std::uint8_t& byte : content.payload) byte = static_cast<std::uint8_t>(random() & 0xFFU);
  return content;
}

bleed_v1_Journal journalEntry(const transport::Uuid& session, std::uint32_t epoch, std::uint64_t number) {
  bleed_v1_Journal entry{};
  transport::copyUuid(session, entry.session);
  entry.epoch = epoch;
  entry.number = number;
  entry.step = number * 10;
  entry.sim_time_s = static_cast<double>(number) * 0.125;
  switch (number % 4) {
    case 1:
      entry.body._d = bleed_v1_JOURNAL_REQUEST;
      entry.body._u.request = woundAdded(number);
      break;
    case 2:
      entry.body._d = bleed_v1_JOURNAL_INSTRUMENT;
      entry.body._u.instrument = instrumentSample(number);
      break;
    case 3:
      entry.body._d = bleed_v1_JOURNAL_INSTRUMENT_END;
      entry.body._u.instrument_end.tool = 3;
      entry.body._u.instrument_end.reason = bleed_v1_INSTRUMENT_END_LOST;
      break;
    default:
      entry.body._d = bleed_v1_JOURNAL_DECISION;
      setText(entry.body._u.decision, "slowed the pace");
  }
  return entry;
}

LiveSource::LiveSource(std::string name, transport::Writer<bleed_v1_Frame> frames, transport::Writer<bleed_v1_FrameStats> stats,
                       transport::Writer<bleed_v1_Scene> scenes, transport::Writer<bleed_v1_Status> statuses,
                       transport::Writer<bleed_v1_Journal> journal)
    : name_{std::move(name)},
      frames_{std::move(frames)},
      stats_{std::move(stats)},
      scenes_{std::move(scenes)},
      statuses_{std::move(statuses)},
      journal_{std::move(journal)} {}

Result<LiveSource> LiveSource::create(const transport::Participant& participant, const std::string& session) {
  auto frames = transport::Writer<bleed_v1_Frame>::create(participant, session);
  if (!frames) return frames.status();
  auto stats = transport::Writer<bleed_v1_FrameStats>::create(participant, session);
  if (!stats) return stats.status();
  auto scenes = transport::Writer<bleed_v1_Scene>::create(participant, session);
  if (!scenes) return scenes.status();
  auto statuses = transport::Writer<bleed_v1_Status>::create(participant, session);
  if (!statuses) return statuses.status();
  auto journal = transport::Writer<bleed_v1_Journal>::create(participant, session);
  if (!journal) return journal.status();
  return LiveSource{
      session, std::move(*frames), std::move(*stats), std::move(*scenes), std::move(*statuses), std::move(*journal)};
}

Status LiveSource::writeScene(std::uint32_t epoch) {
  bleed_v1_Scene scene{};
  transport::copyUuid(session_, scene.session);
  setText(scene.session_name, name_);
  scene.epoch = epoch;
  scene.protocol_major = bleed_v1_PROTOCOL_MAJOR;
  scene.protocol_minor = bleed_v1_PROTOCOL_MINOR;
  setText(scene.version, "1.0.0");
  setText(scene.build_id, "0123abcd");
  setText(scene.scene_name, "live source");
  scene.scene_text = scene_text_.data();
  char effect_buffer[2][65] = {"gravity", "pressure"};
  scene.effects._buffer = effect_buffer;
  scene.effects._length = scene.effects._maximum = 2;
  setText(scene.length_unit, "m");
  setText(scene.axes, "right-handed, +z up");
  scene.spacing_m = 0.003;
  scene.particle_volume_ml = kParticleMl;
  scene.frame_rate_hz = kFrameRateHz;
  scene.capacity = 1000;
  return scenes_.write(scene);
}

Status LiveSource::writeStatus(std::uint32_t epoch, std::uint64_t heartbeat) {
  bleed_v1_Status status{};
  transport::copyUuid(session_, status.session);
  setText(status.session_name, name_);
  status.state = bleed_v1_STATE_RUNNING;
  status.epoch = epoch;
  status.heartbeat = heartbeat;
  setText(status.text, "running");
  return statuses_.write(status);
}

Status LiveSource::writeFrame(const FrameContent& content) {
  std::array<bleed_v1_Attribute, 3> attributes{{{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F},
                                                {bleed_v1_SEMANTIC_ID, bleed_v1_SCALAR_UINT32, 1, 1.0F, 0.0F},
                                                {bleed_v1_SEMANTIC_VELOCITY, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F}}};
  std::vector<std::uint8_t> payload = content.payload;
  bleed_v1_Frame frame{};
  transport::copyUuid(session_, frame.session);
  frame.seq = content.seq;
  frame.step = content.seq * 10;
  frame.sim_time_s = content.sim_time_s;
  frame.monotonic_stamp_ns = static_cast<std::int64_t>(content.seq) * 16'000'000;
  frame.realtime_stamp_ns = 1'700'000'000'000'000'000 + frame.monotonic_stamp_ns;
  frame.epoch = content.epoch;
  frame.count = content.count;
  frame.attributes._buffer = attributes.data();
  frame.attributes._length = frame.attributes._maximum = static_cast<std::uint32_t>(attributes.size());
  frame.payload._buffer = payload.data();
  frame.payload._length = frame.payload._maximum = static_cast<std::uint32_t>(payload.size());
  if (Status written = frames_.write(frame); !written) return written;

  bleed_v1_FrameStats stats{};
  transport::copyUuid(session_, stats.session);
  stats.seq = content.seq;
  stats.epoch = content.epoch;
  stats.step = frame.step;
  stats.sim_time_s = content.sim_time_s;
  stats.particles = content.count;
  stats.emitted_ml = content.count * kParticleMl;
  stats.state_hash = content.seq * 0x9E3779B97F4A7C15U;
  return stats_.write(stats);
}

Status LiveSource::writeJournal(std::uint32_t epoch, std::uint64_t number) {
  return journal_.write(journalEntry(session_, epoch, number));
}

Status LiveSource::settle() {
  constexpr std::chrono::seconds kPatience{20};
  if (Status settled = frames_.waitForAcknowledgements(kPatience); !settled) return settled;
  if (Status settled = stats_.waitForAcknowledgements(kPatience); !settled) return settled;
  return journal_.waitForAcknowledgements(kPatience);
}

}  // namespace bleedsim::recording_test
