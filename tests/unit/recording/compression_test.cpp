// Chunks of every compression, whole and damaged.
#include "service/recording/compression.h"

#include <gtest/gtest.h>
#include <random>

#include "service/recording/convert.h"
#include "service/recording/recording_reader.h"
#include "service/recording/recording_writer.h"
#include "service/recording/summary.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

constexpr std::array<Compression, 3> kAll{Compression::none, Compression::lz4, Compression::zstd};

/// Half noise, half zeros: neither incompressible nor trivial.
std::string someBytes(std::size_t size) {
  std::mt19937_64 random{11};
  std::string out(size, '\0');
  for (std::size_t i = 0; i < size; i += 2) out[i] = static_cast<char>(random() & 0xffU);
  return out;
}

std::string compressed(Compression compression, const std::string& bytes) {
  auto compressor = mcap::Compressor::create(compression, 1);
  EXPECT_TRUE(compressor.ok());
  const auto out = compressor->compress(bytes);
  EXPECT_TRUE(out.ok());
  return std::string{*out};
}

::bleedsim::Status decompress(const std::string& name, const std::string& bytes, std::size_t size, std::string& out) {
  auto decompressor = mcap::Decompressor::create();
  EXPECT_TRUE(decompressor.ok());
  std::vector<std::byte> data;
  const auto status = decompressor->decompress(name, mcap::bytesOf(bytes), size, data);
  out.assign(reinterpret_cast<const char*>(data.data()), data.size());
  return status;
}

TEST(Compression, GivesBackWhatItTook) {
  for (const Compression compression : kAll) {
    for (const std::size_t size : {1U, 100U, 70'000U, 5'000'000U}) {
      const std::string bytes = someBytes(size);
      std::string back;
      const auto status = decompress(mcap::chunkName(compression), compressed(compression, bytes), size, back);
      ASSERT_TRUE(status.ok()) << nameOf(compression) << " " << size << ": " << status.message();
      EXPECT_TRUE(back == bytes) << nameOf(compression) << " " << size;
    }
  }
}

TEST(Compression, IsTheFrameFormatThatMcapAsksFor) {
  const std::string bytes = someBytes(1000);
  EXPECT_EQ(mcap::chunkName(Compression::none), "");
  EXPECT_EQ(compressed(Compression::lz4, bytes).substr(0, 4), "\x04\x22\x4d\x18");
  EXPECT_EQ(compressed(Compression::zstd, bytes).substr(0, 4), "\x28\xb5\x2f\xfd");
}

TEST(Compression, WrongSizesAndDamageAreDataLoss) {
  const std::string bytes = someBytes(10'000);
  std::string back;
  for (const Compression compression : kAll) {
    const std::string name = mcap::chunkName(compression);
    const std::string data = compressed(compression, bytes);
    for (const std::size_t size : {0U, 1U, 9'999U, 10'001U, 50'000U}) {
      EXPECT_EQ(decompress(name, data, size, back).code(), StatusCode::data_loss) << nameOf(compression) << " " << size;
    }
    for (const std::size_t part : {std::size_t{0}, std::size_t{3}, data.size() / 2, data.size() - 1}) {
      EXPECT_EQ(decompress(name, data.substr(0, part), bytes.size(), back).code(), StatusCode::data_loss)
          << nameOf(compression) << " " << part;
    }
    EXPECT_EQ(decompress(name, data + "x", bytes.size(), back).code(), StatusCode::data_loss) << nameOf(compression);
  }
  EXPECT_EQ(decompress("bz2", bytes, bytes.size(), back).code(), StatusCode::unsupported);
}

TEST(Compression, RecordingsOfEachAreReadBack) {
  std::mt19937_64 random{3};
  std::vector<Frame> frames;
  for (std::uint64_t seq = 1; seq <= 20; ++seq) frames.push_back(makeFrame(random, seq, 50));
  for (const Compression compression : kAll) {
    const ScratchFile file{"compressed.mcap"};
    WriterOptions options;
    options.compression = compression;
    options.chunk_bytes = 4000;
    auto writer = RecordingWriter::open(file.path(), options);
    ASSERT_TRUE(writer.ok());
    for (const Frame& frame : frames) {
      auto sample = fromRecording(frame);
      ASSERT_TRUE(sample.ok());
      ASSERT_TRUE(writer->append(**sample).ok());
    }
    ASSERT_TRUE(writer->close().ok());
    auto reader = RecordingReader::open(file.path());
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    const auto summary = summarize(*reader);
    ASSERT_TRUE(summary.ok()) << summary.status().message();
    EXPECT_EQ(summary->compression, nameOf(compression));
    EXPECT_FALSE(summary->max_errors.empty());  // of the 16-bit velocities that came so
    Frame back;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      ASSERT_TRUE(reader->frame(i, back).ok());
      EXPECT_EQ(back.SerializeAsString(), frames[i].SerializeAsString());
    }
  }
}

}  // namespace
}  // namespace bleedsim::recording::test
