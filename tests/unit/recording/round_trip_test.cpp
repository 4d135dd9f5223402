// Messages that come back bit for bit, through the C structs and through the file.
#include <cstring>
#include <gtest/gtest.h>

#include "service/recording/convert.h"
#include "service/recording/recording_reader.h"
#include "service/recording/recording_writer.h"
#include "service/recording/summary.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

template <class Message>
void expectSame(const Message& message) {
  auto sample = fromRecording(message);
  ASSERT_TRUE(sample.ok()) << sample.status().message();
  Message back;
  const auto status = toRecording(**sample, back);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(back.SerializeAsString(), message.SerializeAsString()) << message.DebugString();
}

TEST(RoundTrip, EveryKindOfMessageSurvivesTheStructs) {
  std::mt19937_64 random{1};
  for (std::uint64_t n = 1; n <= 48; ++n) {
    FrameStats stats;
    randomize(random, stats);
    expectSame(stats);
    recording::Status status;
    randomize(random, status);
    expectSame(status);
    Scene scene;
    randomize(random, scene);
    expectSame(scene);
    expectSame(makeFrame(random, n, 13));
    expectSame(makeJournal(random, n, static_cast<int>(n % kJournalKinds)));
  }
}

TEST(RoundTrip, ATextThatFillsItsMemberWithoutAnEndIsRefusedAndNotReadBeyond) {
  bleed_v1_Status status{};
  std::memset(status.host, 'h', sizeof status.host);
  recording::Status message;
  const auto refused = toRecording(status, message);
  EXPECT_EQ(refused.code(), StatusCode::invalid_argument);
  EXPECT_EQ(refused.message(), "status.host has no end; the sample is malformed");
  EXPECT_EQ(message.host(), "");
}

TEST(RoundTrip, ABooleanOfAnyByteIsTrueOrFalse) {
  bleed_v1_Journal journal{};
  journal.body._d = bleed_v1_JOURNAL_REQUEST;
  bleed_v1_RequestBody& body = journal.body._u.request.request.body;
  body._d = bleed_v1_REQUEST_EFFECT;
  std::memset(&body._u.effect.enabled, 0x40, 1);
  Journal message;
  ASSERT_TRUE(toRecording(journal, message).ok());
  EXPECT_TRUE(message.request().request().effect().enabled());
}

TEST(RoundTrip, TheFileGivesBackEveryByteInOrderWhateverTheChunks) {
  for (const std::size_t chunk_bytes : {std::size_t{1024}, std::size_t{1500}, std::size_t{20'000}, std::size_t{4} << 20}) {
    const ScratchFile file{"round_trip.mcap"};
    const std::vector<Stored> written = writeRecording(file.path(), 100, chunk_bytes);
    auto reader = RecordingReader::open(file.path());
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    EXPECT_FALSE(reader->truncated());
    std::size_t at = 0;
    std::uint64_t time = 0;
    for (;;) {
      RecordedMessage message;
      auto more = reader->next(message);
      ASSERT_TRUE(more.ok()) << more.status().message();
      if (!*more) break;
      ASSERT_LT(at, written.size());
      EXPECT_EQ(message.topic, written[at].topic);
      EXPECT_TRUE(std::equal(message.data.begin(), message.data.end(), std::as_bytes(std::span{written[at].bytes}).begin(),
                             std::as_bytes(std::span{written[at].bytes}).end()));
      EXPECT_GT(message.log_time_ns, time);
      time = message.log_time_ns;
      ++at;
    }
    EXPECT_EQ(at, written.size());
  }
}

TEST(RoundTrip, FramesAreFoundByNumber) {
  const ScratchFile file{"by_number.mcap"};
  const std::vector<Stored> written = writeRecording(file.path(), 50, 3000);
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  auto count = reader->frameCount();
  ASSERT_TRUE(count.ok());
  EXPECT_EQ(*count, 50U);
  Frame frame;
  for (const std::size_t index : {49U, 0U, 25U, 24U}) {
    ASSERT_TRUE(reader->frame(index, frame).ok());
    EXPECT_EQ(frame.seq(), index + 1);
  }
  EXPECT_EQ(reader->frame(50, frame).code(), StatusCode::not_found);
}

TEST(RoundTrip, SelectedTopicsComeWholeAndInOrder) {
  const ScratchFile file{"selected.mcap"};
  const std::vector<Stored> written = writeRecording(file.path(), 60, 2000);
  const std::string whole = readAll(file.path());
  // With the index, which tells the chunks to pass over, and without.
  for (const bool cut : {false, true}) {
    if (cut) writeAll(file.path(), whole.substr(0, whole.size() - 10));
    auto reader = RecordingReader::open(file.path());
    ASSERT_TRUE(reader.ok());
    ASSERT_EQ(reader->truncated(), cut);
    for (const std::set<Topic>& topics : {std::set{Topic::scene}, std::set{Topic::status, Topic::journal}, std::set<Topic>{}}) {
      reader->select(topics);
      RecordedMessage message;
      for (const Stored& stored : written) {
        if (!topics.contains(stored.topic)) continue;
        const auto more = reader->next(message);
        ASSERT_TRUE(more.ok() && *more);
        EXPECT_EQ(message.topic, stored.topic);
        EXPECT_EQ((std::string{reinterpret_cast<const char*>(message.data.data()), message.data.size()}), stored.bytes);
      }
      const auto more = reader->next(message);
      EXPECT_TRUE(more.ok() && !*more);
    }
  }
}

TEST(RoundTrip, TheSummaryCounts) {
  const ScratchFile file{"summary.mcap"};
  writeRecording(file.path(), 60, 5000);
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  auto summary = summarize(*reader);
  ASSERT_TRUE(summary.ok()) << summary.status().message();
  EXPECT_EQ(summary->frames, 60U);
  EXPECT_EQ(summary->gaps, 0U);
  EXPECT_EQ(summary->frame_stats, 60U);
  EXPECT_EQ(summary->journal_entries, 20U);
  EXPECT_NEAR(summary->duration_s, 59.0 / 60.0, 1e-12);
  EXPECT_DOUBLE_EQ(summary->ml_emitted, 0.25 * 59);
  EXPECT_DOUBLE_EQ(summary->ml_emitted_total, 15.0);
  EXPECT_TRUE(summary->replayable) << summary->reason;
  EXPECT_EQ(summary->file_bytes, std::filesystem::file_size(file.path()));
}

TEST(RoundTrip, ABadSampleIsLeftOutAndCounted) {
  const ScratchFile file{"bad_sample.mcap"};
  auto writer = RecordingWriter::open(file.path());
  ASSERT_TRUE(writer.ok());
  bleed_v1_Frame hollow{};
  hollow.payload._length = 100;
  EXPECT_EQ(writer->append(hollow).code(), StatusCode::invalid_argument);
  bleed_v1_Status status{};
  std::strcpy(status.text, "\xff\xfe");
  EXPECT_EQ(writer->append(status).code(), StatusCode::invalid_argument);
  bleed_v1_Journal journal{};
  journal.body._d = 99;
  EXPECT_EQ(writer->append(journal).code(), StatusCode::unsupported);
  EXPECT_EQ(writer->counts().refused, 3U);
  EXPECT_TRUE(writer->close().ok());
  EXPECT_EQ(writer->append(bleed_v1_Status{}).code(), StatusCode::wrong_state);
}

TEST(RoundTrip, FramesLostAtTheEndAreInTheFile) {
  const ScratchFile file{"lost_end.mcap"};
  auto writer = RecordingWriter::open(file.path());
  ASSERT_TRUE(writer.ok());
  bleed_v1_Frame frame{};
  for (const std::uint64_t seq : {7U, 9U}) {
    frame.seq = seq;
    ASSERT_TRUE(writer->append(frame).ok());
  }
  writer->publishedUntil(12);
  EXPECT_EQ(writer->counts().gaps, 4U);
  ASSERT_TRUE(writer->close().ok());
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  const auto summary = summarize(*reader);
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->gaps, 4U);
  ASSERT_EQ(summary->gap_ranges.size(), 2U);
  EXPECT_EQ(summary->gap_ranges[1], (std::pair<std::uint64_t, std::uint64_t>{10, 12}));
}

TEST(RoundTrip, DiskErrorsAreReported) {
  auto writer = RecordingWriter::open("/dev/full");
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.status().code(), StatusCode::io);
  EXPECT_NE(writer.status().message().find("space"), std::string::npos) << writer.status().message();
  EXPECT_EQ(RecordingWriter::open("/nonexistent/file.mcap").status().code(), StatusCode::io);
}

}  // namespace
}  // namespace bleedsim::recording::test
