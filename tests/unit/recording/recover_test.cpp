// Recovery of files that were cut off or damaged.
#include "service/recording/recover.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include <set>

#include "service/recording/mcap_reader.h"
#include "service/recording/mcap_writer.h"
#include "service/recording/recording_reader.h"
#include "service/recording/recording_writer.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

std::vector<Stored> messagesOf(const std::filesystem::path& path) {
  std::vector<Stored> out;
  auto reader = RecordingReader::open(path);
  EXPECT_TRUE(reader.ok()) << reader.status().message();
  if (!reader) return out;
  EXPECT_FALSE(reader->truncated()) << reader->truncationReason();
  EXPECT_TRUE(reader->verify().ok());
  RecordedMessage message;
  for (auto more = reader->next(message); more.ok() && *more; more = reader->next(message)) {
    out.push_back({message.topic, {reinterpret_cast<const char*>(message.data.data()), message.data.size()}});
  }
  return out;
}

/// A recording of several chunks, with the file offset and the number of messages at the end of each.
class RecoverTest : public testing::Test {
 protected:
  struct ChunkEnd {
    std::size_t offset = 0;  ///< of the first byte behind the chunk
    std::size_t messages = 0;
  };

  void SetUp() override {
    written_ = writeRecording(whole_.path(), 60, 6000);
    bytes_ = readAll(whole_.path());
    auto file = FileSource::open(whole_.path());
    ASSERT_TRUE(file.ok());
    auto index = mcap::readIndex(*file);
    ASSERT_TRUE(index.ok());
    auto reader = mcap::McapReader::open(whole_.path());
    ASSERT_TRUE(reader.ok());
    std::size_t messages = 0;
    for (std::size_t i = 0; i < index->chunks.size(); ++i) {
      ASSERT_TRUE(reader->loadChunk(i).ok());
      mcap::Message message;
      std::uint64_t position = 0;
      for (auto more = reader->next(position, message); more.ok() && *more; more = reader->next(position, message)) ++messages;
      const mcap::ChunkIndex& chunk = index->chunks[i];
      starts_.push_back(chunk.offset);
      ends_.push_back({chunk.offset + chunk.length, messages});
    }
    ASSERT_GT(ends_.size(), 5U);
    ASSERT_EQ(messages, written_.size());
  }

  void checkCut(std::size_t size) {
    SCOPED_TRACE(size);
    writeAll(cut_.path(), bytes_.substr(0, size));
    std::size_t complete = 0;
    for (const ChunkEnd& end : ends_) {
      if (end.offset <= size) complete = end.messages;
    }
    const auto report = recover(cut_.path(), out_.path());
    if (complete == 0) {
      ASSERT_FALSE(report.ok());
      EXPECT_EQ(report.status().code(), StatusCode::data_loss) << report.status().message();
      EXPECT_FALSE(std::filesystem::exists(out_.path()));
      return;
    }
    ASSERT_TRUE(report.ok()) << report.status().message();
    EXPECT_FALSE(report->reason.empty());
    EXPECT_EQ(report->damaged_chunks, 0U);
    const std::vector<Stored> got = messagesOf(out_.path());
    ASSERT_EQ(got.size(), complete);
    for (std::size_t i = 0; i < got.size(); ++i) {
      ASSERT_EQ(got[i].topic, written_[i].topic) << i;
      ASSERT_EQ(got[i].bytes, written_[i].bytes) << i;
    }
    std::filesystem::remove(out_.path());
  }

  ScratchFile whole_{"recover_whole.mcap"};
  ScratchFile cut_{"recover_cut.mcap"};
  ScratchFile out_{"recover_out.mcap"};
  std::vector<Stored> written_;
  std::string bytes_;
  std::vector<std::size_t> starts_;
  std::vector<ChunkEnd> ends_;
};

TEST_F(RecoverTest, KeepsEveryCompleteChunkOfAFileCutAtAChunk) {
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    for (const std::size_t at : {starts_[i], ends_[i].offset}) {
      checkCut(at - 1);
      checkCut(at);
      checkCut(at + 1);
    }
  }
}

TEST_F(RecoverTest, KeepsEveryCompleteChunkOfAFileCutAnywhere) {
  std::mt19937_64 random{7};
  std::uniform_int_distribution<std::size_t> byte{mcap::kMagic.size(), bytes_.size() - 1};
  for (int i = 0; i < 80; ++i) checkCut(byte(random));
}

TEST_F(RecoverTest, BlocksThatWereNeverWrittenEndTheFile) {
  writeAll(cut_.path(), bytes_.substr(0, ends_[2].offset) + std::string(5000, '\0'));
  ASSERT_TRUE(recover(cut_.path(), out_.path()).ok());
  EXPECT_EQ(messagesOf(out_.path()).size(), ends_[2].messages);
}

TEST_F(RecoverTest, TheNewFileSaysWhatItHoldsAndWhereItComesFrom) {
  writeAll(cut_.path(), bytes_.substr(0, ends_[3].offset));
  const auto report = recover(cut_.path(), out_.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(report->chunks, 4U);
  auto reader = RecordingReader::open(out_.path());
  ASSERT_TRUE(reader.ok());
  const auto& recording = reader->metadata().at("bleedsim.recording");
  EXPECT_EQ(recording.at("frames"), std::to_string(report->summary.frames));
  EXPECT_EQ(recording.at("replayable"), "true") << recording.at("reason");
  EXPECT_EQ(recording.at("scene_name"), report->summary.scene_name);
  const auto& recovered = reader->metadata().at("bleedsim.recovered");
  EXPECT_EQ(recovered.at("from"), cut_.path().filename().string());
  EXPECT_EQ(recovered.at("reason"), report->reason);
  const auto summary = summarize(*reader);
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->frames, report->summary.frames);
  EXPECT_EQ(summary->file_bytes, std::filesystem::file_size(out_.path()));
  EXPECT_EQ(summary->file_bytes, report->summary.file_bytes);
  Frame frame;
  EXPECT_TRUE(reader->frame(summary->frames - 1, frame).ok()) << "the frames are indexed";
}

TEST_F(RecoverTest, ADamagedChunkIsLeftOutAndTheOthersKept) {
  std::string damaged = bytes_;
  const std::size_t inside = (starts_[2] + ends_[2].offset) / 2;
  damaged[inside] = static_cast<char>(static_cast<unsigned char>(damaged[inside]) ^ 0x5aU);
  writeAll(cut_.path(), damaged);
  const auto report = recover(cut_.path(), out_.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(report->damaged_chunks, 1U);
  EXPECT_EQ(report->chunks, ends_.size() - 1);
  EXPECT_EQ(messagesOf(out_.path()).size(), written_.size() - (ends_[2].messages - ends_[1].messages));
  EXPECT_GT(report->summary.gaps, 0U);
}

// Found by the fuzzer: chunks whose messages belong to no channel of the file.
TEST_F(RecoverTest, AFileWithoutMessagesHasNothingToRecover) {
  const auto report = recover(BLEEDSIM_SOURCE_DIR "/tests/fuzz/corpus/recording/no_messages", out_.path());
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.status().code(), StatusCode::data_loss);
  EXPECT_NE(report.status().message().find("nothing to recover"), std::string::npos) << report.status().message();
  EXPECT_FALSE(std::filesystem::exists(out_.path()));
}

TEST_F(RecoverTest, ADamagedIndexIsMadeAnew) {
  std::string damaged = bytes_;
  const std::size_t inside = damaged.size() - 100;
  damaged[inside] = static_cast<char>(static_cast<unsigned char>(damaged[inside]) ^ 0x5aU);
  writeAll(cut_.path(), damaged);
  ASSERT_FALSE(RecordingReader::open(cut_.path()).ok());
  EXPECT_TRUE(isRecoverable(cut_.path()));
  const auto report = recover(cut_.path(), out_.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_FALSE(report->reason.empty());
  EXPECT_EQ(messagesOf(out_.path()).size(), written_.size());
}

TEST_F(RecoverTest, NoFlippedByteStopsItFromGivingACompleteFile) {
  std::size_t recovered = 0;
  for (std::size_t at = 0; at < bytes_.size(); at += 1 + bytes_.size() / 150) {
    SCOPED_TRACE(at);
    std::string damaged = bytes_;
    damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ 0x5aU);
    writeAll(cut_.path(), damaged);
    const auto report = recover(cut_.path(), out_.path());
    if (!report) {
      // The file's first bytes, or the record that names a channel or its schema.
      EXPECT_LT(at, starts_[0]) << report.status().message();
      continue;
    }
    ++recovered;
    EXPECT_LE(messagesOf(out_.path()).size(), written_.size());
  }
  EXPECT_GT(recovered, 50U);
}

TEST_F(RecoverTest, AWholeFileIsCopied) {
  const auto report = recover(whole_.path(), out_.path());
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->reason.empty());
  EXPECT_EQ(messagesOf(out_.path()).size(), written_.size());
}

TEST_F(RecoverTest, GivenUpItLeavesNothing) {
  writeAll(out_.path(), "an older file");
  std::size_t calls = 0;
  const auto give_up = [&](std::size_t done, std::size_t total) {
    ++calls;
    EXPECT_EQ(done, calls);
    EXPECT_EQ(total, ends_.size());
    return calls < 2;
  };
  EXPECT_EQ(recover(whole_.path(), out_.path(), give_up).status().code(), StatusCode::wrong_state);
  EXPECT_EQ(calls, 2U);
  EXPECT_EQ(readAll(out_.path()), "an older file");
  for (const auto& entry : std::filesystem::directory_iterator{out_.path().parent_path()}) {
    EXPECT_EQ(entry.path().string().find(out_.path().string() + "."), std::string::npos) << entry.path();
  }
}

TEST_F(RecoverTest, NeitherTheOldFileNorWhatStandsInTheWayIsHarmed) {
  EXPECT_EQ(recover(whole_.path(), whole_.path()).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(readAll(whole_.path()), bytes_);
  EXPECT_EQ(recover(whole_.path(), testing::TempDir()).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(recover(whole_.path(), "/dev/full").status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(recover(whole_.path(), "/nonexistent/out.mcap").status().code(), StatusCode::io);
  EXPECT_EQ(recover("/nonexistent.mcap", out_.path()).status().code(), StatusCode::not_found);
  writeAll(out_.path(), "an older file");
  writeAll(cut_.path(), "no recording, but long enough to be looked at");
  EXPECT_EQ(recover(cut_.path(), out_.path()).status().code(), StatusCode::data_loss);
  EXPECT_EQ(readAll(out_.path()), "an older file");
}

TEST(Recover, FramesThatARateLeftOutAreNoGaps) {
  const ScratchFile whole{"thin.mcap"};
  const ScratchFile cut{"thin_cut.mcap"};
  const ScratchFile out{"thin_out.mcap"};
  for (const bool rated : {true, false}) {
    WriterOptions options;
    options.chunk_bytes = 1024;
    if (rated) options.notes["rate_hz"] = "20";
    auto writer = RecordingWriter::open(whole.path(), options);
    ASSERT_TRUE(writer.ok());
    bleed_v1_Frame frame{};
    std::vector<std::uint8_t> payload(1000);
    frame.payload._buffer = payload.data();
    frame.payload._length = frame.payload._maximum = static_cast<std::uint32_t>(payload.size());
    for (frame.seq = 1; frame.seq <= 31; frame.seq += 3) ASSERT_TRUE(writer->append(frame).ok());
    ASSERT_TRUE(writer->close().ok());
    const std::string bytes = readAll(whole.path());
    // All chunks are there, but nothing of what follows them.
    auto file = FileSource::open(whole.path());
    auto index = mcap::readIndex(*file);
    ASSERT_TRUE(index.ok());
    writeAll(cut.path(), bytes.substr(0, index->chunks.back().offset + index->chunks.back().length));
    ASSERT_TRUE(recover(cut.path(), out.path()).ok());
    for (const auto& path : {cut.path(), out.path()}) {
      auto reader = RecordingReader::open(path);
      ASSERT_TRUE(reader.ok());
      const auto summary = summarize(*reader);
      ASSERT_TRUE(summary.ok());
      EXPECT_EQ(summary->frames, 11U);
      EXPECT_EQ(summary->gaps, rated ? 0U : 20U);
      EXPECT_EQ(summary->skipped, rated ? 20U : 0U);
    }
  }
}

}  // namespace
}  // namespace bleedsim::recording::test
