// A session on the wire -> recording -> figures, every byte back, and the export.
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <optional>
#include <set>
#include <unistd.h>

#include "service/recording/convert.h"
#include "service/recording/export.h"
#include "service/recording/recording_reader.h"
#include "service/recording/summary.h"
#include "tests/integration/recording/live_source.h"
#include "tests/integration/recording/stream_recorder.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::recording_test {
namespace {

namespace rec = bleedsim::recording;

constexpr std::size_t kPositionBytes = 12;

class LiveRecording : public testing::Test {
 protected:
  void SetUp() override {
    auto participant = transport::Participant::create({.domain = 81, .tag = fmt::format("r{}", getpid())});
    ASSERT_TRUE(participant.ok()) << participant.status().message();
    auto source = LiveSource::create(*participant, "theatre");
    ASSERT_TRUE(source.ok()) << source.status().message();
    source_.emplace(std::move(*source));
    participant_.emplace(*participant);
  }

  LiveSource& source() { return *source_; }
  std::filesystem::path file() const { return folder_ / "live.mcap"; }
  const std::filesystem::path& folder() const { return folder_; }

  void startRecorder() {
    auto recorder = StreamRecorder::create(*participant_, "theatre", file());
    ASSERT_TRUE(recorder.ok()) << recorder.status().message();
    recorder_.emplace(std::move(*recorder));
    ASSERT_EQ(source().frameReaders(), 1U);
  }
  StreamRecorder& recorder() { return *recorder_; }

  /// Sends one frame and waits until it and its stats are in the file.
  void recordFrame(const FrameContent& content) {
    const std::uint64_t frames = recorder().counts().frames + 1;
    const std::uint64_t stats = recorder().counts().frame_stats + 1;
    ASSERT_TRUE(source().writeFrame(content).ok());
    const Status recorded = recorder().recordUntil(
        [&](const rec::WriterCounts& counts) { return counts.frames >= frames && counts.frame_stats >= stats; });
    ASSERT_TRUE(recorded.ok()) << recorded.message();
  }
  void recordJournal(std::uint32_t epoch, std::uint64_t number) {
    const std::uint64_t entries = recorder().counts().journal_entries + 1;
    ASSERT_TRUE(source().writeJournal(epoch, number).ok());
    const Status recorded =
        recorder().recordUntil([&](const rec::WriterCounts& counts) { return counts.journal_entries >= entries; });
    ASSERT_TRUE(recorded.ok()) << recorded.message();
  }

  rec::RecordingSummary summary() {
    auto reader = rec::RecordingReader::open(file());
    EXPECT_TRUE(reader.ok()) << reader.status().message();
    if (!reader) return {};
    auto result = rec::summarize(*reader);
    EXPECT_TRUE(result.ok()) << result.status().message();
    return result ? *result : rec::RecordingSummary{};
  }

 private:
  const test::TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
  std::optional<transport::Participant> participant_;
  std::optional<LiveSource> source_;
  std::optional<StreamRecorder> recorder_;
};

void expectSameFrame(const bleed_v1_Frame& read, const FrameContent& sent, const transport::Uuid& session) {
  EXPECT_EQ(transport::toUuid(read.session), session);
  EXPECT_EQ(read.seq, sent.seq);
  EXPECT_EQ(read.step, sent.seq * 10);
  EXPECT_EQ(read.sim_time_s, sent.sim_time_s);
  EXPECT_EQ(read.realtime_stamp_ns - read.monotonic_stamp_ns, 1'700'000'000'000'000'000);
  EXPECT_EQ(read.epoch, sent.epoch);
  EXPECT_EQ(read.count, sent.count);
  ASSERT_EQ(read.attributes._length, 3U);
  EXPECT_EQ(read.attributes._buffer[2].semantic, std::uint32_t{bleed_v1_SEMANTIC_VELOCITY});
  ASSERT_EQ(read.payload._length, sent.payload.size());
  EXPECT_TRUE(sent.payload.empty() || std::memcmp(read.payload._buffer, sent.payload.data(), sent.payload.size()) == 0);
}

void expectSameJournal(const bleed_v1_Journal& read, const bleed_v1_Journal& sent) {
  EXPECT_EQ(read.number, sent.number);
  EXPECT_EQ(read.step, sent.step);
  EXPECT_EQ(read.sim_time_s, sent.sim_time_s);
  ASSERT_EQ(read.body._d, sent.body._d);
  if (sent.body._d == bleed_v1_JOURNAL_REQUEST) {
    const bleed_v1_RequestApplied& got = read.body._u.request;
    EXPECT_EQ(got.object_id, sent.body._u.request.object_id);
    EXPECT_EQ(got.request.run, 77U);
    ASSERT_EQ(got.request.body._d, std::uint32_t{bleed_v1_REQUEST_WOUND_ADD});
    EXPECT_STREQ(got.request.body._u.wound_add.name, "second wound");
    EXPECT_EQ(got.request.body._u.wound_add.position.y, -0.02);
    EXPECT_EQ(got.request.body._u.wound_add.flow_ml_per_s, 2.0);
  } else if (sent.body._d == bleed_v1_JOURNAL_INSTRUMENT) {
    EXPECT_STREQ(read.body._u.instrument.name, "PSM1");
    EXPECT_EQ(read.body._u.instrument.seq, sent.body._u.instrument.seq);
    EXPECT_EQ(read.body._u.instrument.force.z, -0.25);
  } else if (sent.body._d == bleed_v1_JOURNAL_INSTRUMENT_END) {
    EXPECT_EQ(read.body._u.instrument_end.reason, std::uint32_t{bleed_v1_INSTRUMENT_END_LOST});
  } else {
    EXPECT_STREQ(read.body._u.decision, sent.body._u.decision);
  }
}

TEST_F(LiveRecording, GivesBackEveryByteOfASessionJoinedLate) {
  constexpr std::uint64_t kFrames = 40;
  constexpr std::uint64_t kEntries = 8;
  ASSERT_TRUE(source().writeScene(1).ok());
  ASSERT_TRUE(source().writeStatus(1, 1).ok());
  for (std::uint64_t number = 1; number <= 3; ++number) ASSERT_TRUE(source().writeJournal(1, number).ok());
  startRecorder();
  const Status history = recorder().recordUntil(
      [](const rec::WriterCounts& counts) { return counts.scenes == 1 && counts.statuses == 1 && counts.journal_entries == 3; });
  ASSERT_TRUE(history.ok()) << history.message();
  for (std::uint64_t seq = 5; seq < 5 + kFrames; ++seq) {
    recordFrame(frameContent(seq, 1, static_cast<std::uint32_t>(seq * 7)));
    if (seq % 8 == 0) recordJournal(1, 3 + seq / 8);
  }
  ASSERT_TRUE(recorder().close().ok());

  const rec::RecordingSummary figures = summary();
  EXPECT_EQ(figures.frames, kFrames);
  EXPECT_EQ(figures.gaps, 0U);
  EXPECT_EQ(figures.frame_stats, kFrames);
  EXPECT_EQ(figures.first_particles, 35U);
  EXPECT_EQ(figures.last_particles, 44U * 7U);
  EXPECT_NEAR(figures.duration_s, 39.0 / 60.0, 1e-12);
  EXPECT_EQ(figures.journal_entries, kEntries);
  EXPECT_TRUE(figures.replayable) << figures.reason;
  EXPECT_FALSE(figures.truncated);
  EXPECT_EQ(figures.scene_name, "live source");
  EXPECT_EQ(figures.build_id, "0123abcd");
  EXPECT_NEAR(figures.ml_emitted_total, 44.0 * 7.0 * 0.027, 1e-9);

  auto reader = rec::RecordingReader::open(file());
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  std::uint64_t seq = 5;
  std::uint64_t number = 1;
  rec::RecordedMessage message;
  for (;;) {
    const auto more = reader->next(message);
    ASSERT_TRUE(more.ok()) << more.status().message();
    if (!*more) break;
    if (message.topic == rec::Topic::frame) {
      rec::Frame frame;
      ASSERT_TRUE(rec::decode(message, frame).ok());
      const auto sample = rec::fromRecording(frame);
      ASSERT_TRUE(sample.ok()) << sample.status().message();
      expectSameFrame(**sample, frameContent(seq, 1, static_cast<std::uint32_t>(seq * 7)), source().session());
      ++seq;
    } else if (message.topic == rec::Topic::journal) {
      rec::Journal journal;
      ASSERT_TRUE(rec::decode(message, journal).ok());
      const auto sample = rec::fromRecording(journal);
      ASSERT_TRUE(sample.ok()) << sample.status().message();
      expectSameJournal(**sample, journalEntry(source().session(), 1, number));
      ++number;
    } else if (message.topic == rec::Topic::scene) {
      rec::Scene scene;
      ASSERT_TRUE(rec::decode(message, scene).ok());
      EXPECT_EQ(scene.scene_text(), source().sceneText());
      ASSERT_EQ(scene.effects_size(), 2);
      EXPECT_EQ(scene.effects(1), "pressure");
    }
  }
  EXPECT_EQ(seq, 5 + kFrames);
  EXPECT_EQ(number, kEntries + 1);
}

TEST_F(LiveRecording, CountsWhatIsMissingPerEpoch) {
  ASSERT_TRUE(source().writeScene(1).ok());
  startRecorder();
  const std::set<std::uint64_t> lost{11, 12, 13, 30};
  for (std::uint64_t seq = 10; seq <= 40; ++seq) {
    if (!lost.contains(seq)) recordFrame(frameContent(seq, 1, 3));
  }
  recordJournal(1, 1);
  ASSERT_TRUE(source().writeScene(2).ok());
  recordJournal(2, 2);  // number 1 of the second epoch never arrives
  for (std::uint64_t seq = 41; seq <= 45; ++seq) recordFrame(frameContent(seq, 2, 0));
  ASSERT_TRUE(recorder().close().ok());

  const rec::RecordingSummary figures = summary();
  EXPECT_EQ(figures.frames, 32U);
  EXPECT_EQ(figures.gaps, lost.size());
  ASSERT_EQ(figures.gap_ranges.size(), 2U);
  EXPECT_EQ(figures.gap_ranges[0], (std::pair<std::uint64_t, std::uint64_t>{11, 13}));
  EXPECT_EQ(figures.epochs, 2U);
  EXPECT_EQ(figures.last_particles, 0U);
  EXPECT_FALSE(figures.replayable);
  EXPECT_FALSE(figures.reason.empty());
}

TEST_F(LiveRecording, ExportsTheSameBytes) {
  startRecorder();
  constexpr std::uint64_t kFrames = 4;
  for (std::uint64_t seq = 1; seq <= kFrames; ++seq) recordFrame(frameContent(seq, 1, 50));
  ASSERT_TRUE(recorder().close().ok());

  const auto report = rec::exportRecording(file(), rec::ExportFormat::vtp, folder() / "vtp");
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(report->frames, kFrames);
  EXPECT_TRUE(std::filesystem::exists(report->output));
  for (std::uint64_t seq = 1; seq <= kFrames; ++seq) {
    std::ifstream in{folder() / "vtp" / fmt::format("frame_{:06}.vtp", seq - 1), std::ios::binary};
    ASSERT_TRUE(in.good());
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    const FrameContent sent = frameContent(seq, 1, 50);
    const std::string positions{reinterpret_cast<const char*>(sent.payload.data()), 50 * kPositionBytes};
    EXPECT_NE(text.find(positions), std::string::npos) << "frame " << seq;
  }
}

}  // namespace
}  // namespace bleedsim::recording_test
