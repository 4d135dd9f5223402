// Disks that are slow, full or limited: writing never waits, memory stays bounded, and the error says what to do.
#include "service/recording/write_queue.h"

#include <csignal>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "service/recording/mcap_index.h"
#include "service/recording/recording_reader.h"
#include "service/recording/recording_writer.h"
#include "service/recording/recover.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

using testing::HasSubstr;

/// A file that takes nothing until the test reads it: the slowest of disks.
class SlowFile {
 public:
  explicit SlowFile(const std::string& name) : file_{name} {
    std::filesystem::remove(file_.path());
    EXPECT_EQ(::mkfifo(file_.path().c_str(), 0600), 0);
    descriptor_ = ::open(file_.path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    EXPECT_GE(descriptor_, 0);
    EXPECT_EQ(::fcntl(descriptor_, F_SETFL, 0), 0) << "reads wait from now on";
  }
  SlowFile(const SlowFile&) = delete;
  SlowFile& operator=(const SlowFile&) = delete;
  ~SlowFile() { ::close(descriptor_); }

  const std::filesystem::path& path() const { return file_.path(); }
  /// Everything up to the writer's end.
  std::string read() const {
    std::string out;
    std::string part(std::size_t{1} << 16, '\0');
    for (ssize_t got = ::read(descriptor_, part.data(), part.size()); got > 0;
         got = ::read(descriptor_, part.data(), part.size())) {
      out.append(part.data(), static_cast<std::size_t>(got));
    }
    return out;
  }

 private:
  ScratchFile file_;
  int descriptor_ = -1;
};

/// Frames of 100 kB that do not compress, until the writer refuses one; gives its answer. Empty after `limit` frames.
::bleedsim::Status appendUntilRefused(RecordingWriter& writer, std::uint64_t limit) {
  std::mt19937_64 random{3};
  std::vector<std::uint8_t> payload(100'000);
  bleed_v1_Frame frame{};
  frame.payload._buffer = payload.data();
  frame.payload._length = frame.payload._maximum = static_cast<std::uint32_t>(payload.size());
  for (frame.seq = 1; frame.seq <= limit; ++frame.seq) {
    for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random());
    if (::bleedsim::Status status = writer.append(frame); !status) return status;
  }
  return {};
}

TEST(WriteQueue, TakesBlocksInOrderAndChecksumsThem) {
  const ScratchFile file{"queue.bin"};
  auto queue = WriteQueue::open(file.path(), 1 << 20);
  ASSERT_TRUE(queue.ok());
  std::string all;
  for (int i = 0; i < 200; ++i) {
    const std::string block(static_cast<std::size_t>(i), static_cast<char>('a' + i % 26));
    all += block;
    ASSERT_TRUE(queue->write(block).ok());
  }
  ASSERT_TRUE(queue->flush().ok());
  EXPECT_EQ(readAll(file.path()), all);
  EXPECT_EQ(queue->bytes(), all.size());
  EXPECT_EQ(queue->crc(), mcap::crc32(0, mcap::bytesOf(all)));
  EXPECT_TRUE(queue->close().ok());
  EXPECT_EQ(queue->write("more").code(), StatusCode::wrong_state);
}

TEST(WriteQueue, HoldsNoMoreThanTheLimitOneBlockAndTheEnd) {
  const SlowFile slow{"bound.bin"};
  constexpr std::size_t kLimit = std::size_t{256} << 10;
  constexpr std::size_t kPipe = std::size_t{64} << 10;  // what the system takes from the queue
  const std::string block(std::size_t{100} << 10, 'b');
  auto queue = WriteQueue::open(slow.path(), kLimit);
  ASSERT_TRUE(queue.ok());
  std::string taken;
  ::bleedsim::Status refused;
  for (int i = 0; i < 20; ++i) {
    const ::bleedsim::Status status = queue->write(block);
    if (status) {
      ASSERT_TRUE(refused.ok()) << "it stays so";
      taken += block;
    } else {
      refused = status;
    }
  }
  EXPECT_EQ(refused.code(), StatusCode::io);
  EXPECT_THAT(refused.message(), HasSubstr("the disk is too slow"));
  EXPECT_EQ(queue->bytes(), taken.size());
  EXPECT_GT(taken.size(), kLimit);
  EXPECT_LE(taken.size(), kLimit + block.size() + kPipe);
  EXPECT_TRUE(queue->writeEnd("the end").ok());
  taken += "the end";
  std::string got;
  std::thread reader{[&] { got = slow.read(); }};
  EXPECT_EQ(queue->close().message(), refused.message());
  reader.join();
  EXPECT_EQ(got, taken);
  EXPECT_EQ(queue->crc(), mcap::crc32(0, mcap::bytesOf(taken)));
}

TEST(WriteQueue, ASlowDiskEndsTheRecordingWithACompleteFile) {
  const SlowFile slow{"slow.mcap"};
  const ScratchFile copy{"slow_copy.mcap"};
  WriterOptions options;
  options.queue_bytes = 512 << 10;
  std::string got;
  std::thread reader;
  {
    auto writer = RecordingWriter::open(slow.path(), options);
    ASSERT_TRUE(writer.ok()) << writer.status().message();
    // The pipe holds 64 KiB: no append may wait for the reader, who has not begun. The memory is bounded by the queue and two
    // chunks of 1 MiB.
    const ::bleedsim::Status refused = appendUntilRefused(*writer, 100);
    EXPECT_EQ(refused.code(), StatusCode::io);
    EXPECT_THAT(refused.message(), testing::AllOf(HasSubstr("the disk is too slow"), HasSubstr("slow.mcap")));
    EXPECT_LT(writer->counts().frames, 40U);
    EXPECT_GT(writer->counts().frames, 5U);
    EXPECT_EQ(writer->append(bleed_v1_Status{}).code(), StatusCode::io) << "it stays so";
    const std::uint64_t bytes = writer->counts().bytes;
    EXPECT_EQ(writer->tick(std::chrono::steady_clock::now() + std::chrono::hours{1}).code(), StatusCode::io);
    EXPECT_EQ(writer->counts().bytes, bytes) << "the open chunk waits for the end";
    reader = std::thread{[&] { got = slow.read(); }};
    const ::bleedsim::Status closed = writer->close();
    EXPECT_EQ(closed.code(), StatusCode::io);
    EXPECT_THAT(closed.message(), HasSubstr("the disk is too slow"));
    reader.join();
    writeAll(copy.path(), got);
    auto file = RecordingReader::open(copy.path());
    ASSERT_TRUE(file.ok()) << file.status().message();
    EXPECT_FALSE(file->truncated()) << file->truncationReason();
    EXPECT_TRUE(file->verify().ok());
    EXPECT_EQ(*file->frameCount(), writer->counts().frames);
  }
}

TEST(WriteQueue, AFullDiskEndsTheRecordingAndWhatCameIsRecoverable) {
  // A limit to the size of files fails as a full disk does, in the middle of a write.
  const ScratchFile file{"full.mcap"};
  const ScratchFile out{"full_out.mcap"};
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limited = before;
  limited.rlim_cur = 3'000'000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limited), 0);
  ::bleedsim::Status refused;
  ::bleedsim::Status closed;
  WriterOptions options;
  options.chunk_age = std::chrono::hours{1};
  {
    auto writer = RecordingWriter::open(file.path(), options);
    ASSERT_TRUE(writer.ok());
    refused = appendUntilRefused(*writer, 2000);
    closed = writer->close();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(refused.code(), StatusCode::io);
  EXPECT_THAT(refused.message(), HasSubstr("free space"));
  EXPECT_EQ(closed.message(), refused.message());
  EXPECT_EQ(std::filesystem::file_size(file.path()), 3'000'000U);
  const auto report = recover(file.path(), out.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  // Chunks of ten frames each: two are whole.
  EXPECT_EQ(report->chunks, 2U);
  EXPECT_EQ(report->summary.frames, 20U);
  EXPECT_EQ(report->summary.gaps, 0U);
}

TEST(WriteQueue, AnOldChunkIsWrittenThoughNothingFollows) {
  const ScratchFile file{"old_chunk.mcap"};
  auto writer = RecordingWriter::open(file.path());
  ASSERT_TRUE(writer.ok());
  const std::uint64_t empty = writer->counts().bytes;
  bleed_v1_Status status{};
  ASSERT_TRUE(writer->append(status).ok());
  const auto now = std::chrono::steady_clock::now();
  ASSERT_TRUE(writer->tick(now).ok());
  EXPECT_EQ(writer->counts().bytes, empty);
  ASSERT_TRUE(writer->tick(now + WriterOptions{}.chunk_age).ok());
  const std::uint64_t one = writer->counts().bytes;
  EXPECT_GT(one, empty);
  ASSERT_TRUE(writer->tick(now + std::chrono::hours{1}).ok());
  EXPECT_EQ(writer->counts().bytes, one) << "no empty chunks";
}

TEST(WriteQueue, AChunkIsWrittenAtOneMebibyte) {
  const ScratchFile file{"chunk_size.mcap"};
  WriterOptions options;
  options.chunk_age = std::chrono::hours{1};
  auto writer = RecordingWriter::open(file.path(), options);
  ASSERT_TRUE(writer.ok());
  const std::uint64_t empty = writer->counts().bytes;
  std::vector<std::uint8_t> payload(std::size_t{3} << 20);
  bleed_v1_Frame frame{};
  frame.seq = 1;
  frame.payload._buffer = payload.data();
  frame.payload._length = frame.payload._maximum = 1000;
  ASSERT_TRUE(writer->append(frame).ok());
  EXPECT_EQ(writer->counts().bytes, empty);
  frame.seq = 2;
  frame.payload._length = frame.payload._maximum = static_cast<std::uint32_t>(payload.size());
  ASSERT_TRUE(writer->append(frame).ok());
  const std::uint64_t both = writer->counts().bytes;
  ASSERT_TRUE(writer->tick(std::chrono::steady_clock::now() + std::chrono::hours{2}).ok());
  EXPECT_EQ(writer->counts().bytes, both) << "the large frame does not wait for another message";
  ASSERT_TRUE(writer->close().ok());
  auto source = FileSource::open(file.path());
  const auto index = mcap::readIndex(*source);
  ASSERT_TRUE(index.ok());
  ASSERT_EQ(index->chunks.size(), 2U);
  EXPECT_LT(index->chunks[0].uncompressed_bytes, 2000U);
}

}  // namespace
}  // namespace bleedsim::recording::test
