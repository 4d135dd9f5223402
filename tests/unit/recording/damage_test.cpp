// Files that were cut off or damaged.
#include <gtest/gtest.h>

#include "service/recording/mcap_index.h"
#include "service/recording/recording_reader.h"
#include "service/recording/summary.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

TEST(Damage, AFileCutOffAnywhereGivesItsCompleteChunks) {
  const ScratchFile whole{"whole.mcap"};
  const ScratchFile cut{"cut.mcap"};
  const std::vector<Stored> written = writeRecording(whole.path(), 120, 2000);
  const std::string bytes = readAll(whole.path());
  std::size_t most = 0;
  for (std::size_t part = 1; part < 50; ++part) {
    writeAll(cut.path(), bytes.substr(0, bytes.size() * part / 50));
    auto reader = RecordingReader::open(cut.path());
    ASSERT_TRUE(reader.ok()) << part << ": " << reader.status().message();
    EXPECT_TRUE(reader->truncated());
    EXPECT_FALSE(reader->truncationReason().empty());
    std::size_t at = 0;
    for (;;) {
      RecordedMessage message;
      auto more = reader->next(message);
      ASSERT_TRUE(more.ok()) << part << ": " << more.status().message();
      if (!*more) break;
      ASSERT_LT(at, written.size());
      ASSERT_EQ(message.topic, written[at].topic);
      ASSERT_EQ(message.data.size(), written[at].bytes.size());
      ++at;
    }
    EXPECT_GE(at, most);
    most = at;
    Result<std::size_t> frames = reader->frameCount();
    ASSERT_TRUE(frames.ok());
    EXPECT_TRUE(summarize(*reader).ok());
  }
  EXPECT_GT(most, written.size() / 2);
}

TEST(Damage, EveryFlippedByteIsFound) {
  const ScratchFile whole{"flip_whole.mcap"};
  const ScratchFile flipped{"flip.mcap"};
  writeRecording(whole.path(), 40, 4000);
  const std::string bytes = readAll(whole.path());
  for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 400) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ 0x5aU);
    writeAll(flipped.path(), damaged);
    auto reader = RecordingReader::open(flipped.path());
    if (!reader) {
      EXPECT_EQ(reader.status().code(), StatusCode::data_loss) << at << ": " << reader.status().message();
      continue;
    }
    auto summary = summarize(*reader);
    // A damaged footer makes the file look cut off, and that is said.
    if (summary.ok()) {
      EXPECT_TRUE(summary->truncated) << at;
    } else {
      EXPECT_EQ(summary.status().code(), StatusCode::data_loss) << at << ": " << summary.status().message();
    }
  }
}

TEST(Damage, HugeLengthsAreRefused) {
  const ScratchFile file{"huge.mcap"};
  std::string bytes{mcap::kMagic};
  mcap::appendHeader(bytes, "", "test");
  mcap::appendRecord(bytes, mcap::ChunkHead{1, 2, std::uint64_t{1} << 40, 0, "zstd", 4}, "abcd");
  writeAll(file.path(), bytes);
  auto reader = RecordingReader::open(file.path());
  ASSERT_FALSE(reader.ok());
  EXPECT_EQ(reader.status().code(), StatusCode::data_loss);
  EXPECT_NE(reader.status().message().find("larger than"), std::string::npos) << reader.status().message();
}

TEST(Damage, OtherFilesAreNoRecordings) {
  const ScratchFile file{"other.mcap"};
  for (const std::string& content : {std::string{}, std::string{"abc"}, std::string(500, 'x')}) {
    writeAll(file.path(), content);
    auto reader = RecordingReader::open(file.path());
    ASSERT_FALSE(reader.ok());
    EXPECT_EQ(reader.status().code(), StatusCode::data_loss);
  }
  EXPECT_EQ(RecordingReader::open("/nonexistent.mcap").status().code(), StatusCode::not_found);
  EXPECT_EQ(RecordingReader::open(testing::TempDir()).status().code(), StatusCode::io);
}

}  // namespace
}  // namespace bleedsim::recording::test
