// The file against the format's specification, read here without our reader.
#include <gtest/gtest.h>
#include <map>

#include "service/recording/mcap_records.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return value;
}

TEST(Structure, FollowsTheSpecification) {
  const ScratchFile file{"structure.mcap"};
  writeRecording(file.path(), 40, 4000);
  const std::string bytes = readAll(file.path());
  const std::string magic{"\x89MCAP0\r\n", 8};
  ASSERT_EQ(bytes.substr(0, 8), magic);
  ASSERT_EQ(bytes.substr(bytes.size() - 8), magic);

  std::map<int, int> kinds;
  std::size_t data_end = 0;
  std::size_t footer = 0;
  int first = 0;
  for (std::size_t at = 8; at < bytes.size() - 8;) {
    const int opcode = static_cast<unsigned char>(bytes[at]);
    if (first == 0) first = opcode;
    const std::uint64_t length = number(bytes, at + 1, 8);
    ++kinds[opcode];
    if (opcode == 0x06) {
      EXPECT_GT(number(bytes, at + 9, 8), 0U) << "start time of a chunk";
      EXPECT_GT(number(bytes, at + 25, 8), 0U) << "uncompressed size";
      EXPECT_EQ(kinds[0x04], 5) << "channels stand before the first chunk";
    }
    if (opcode == 0x0f) data_end = at;
    if (opcode == 0x02) footer = at;
    at += 9 + length;
  }
  EXPECT_EQ(first, 0x01);
  EXPECT_EQ(kinds[0x03], 10) << "five schemas, twice";
  EXPECT_EQ(kinds[0x04], 10) << "five channels, twice";
  EXPECT_GT(kinds[0x06], 3);
  EXPECT_EQ(kinds[0x06], kinds[0x08]) << "an index for each chunk";
  EXPECT_EQ(kinds[0x0b], 1);
  EXPECT_EQ(kinds[0x0c], kinds[0x0d]);
  EXPECT_GT(kinds[0x0e], 0);
  ASSERT_EQ(footer, bytes.size() - 8 - 29);
  ASSERT_EQ(number(bytes, footer + 9, 8), data_end + 13) << "the summary follows the end of the data";
  const std::size_t summary = data_end + 13;
  EXPECT_EQ(number(bytes, footer + 25, 4),
            mcap::crc32(0, mcap::bytesOf(std::string_view{bytes}.substr(summary, footer + 25 - summary))));
  EXPECT_EQ(number(bytes, data_end + 9, 4), mcap::crc32(0, mcap::bytesOf(std::string_view{bytes}.substr(0, data_end))));
}

/// What the memory of a long recording grows by, as the README tells it.
TEST(Structure, AChunkAdds77BytesToTheIndexAnd10ForEachTopic) {
  mcap::ChunkIndex index;
  index.compression = "zstd";
  for (std::uint16_t topics = 0; topics <= 5; ++topics) {
    std::string records;
    appendRecord(records, index);
    EXPECT_EQ(records.size(), 77U + 10U * topics);
    index.message_index_offsets[static_cast<std::uint16_t>(topics + 1)] = 1;
  }
}

}  // namespace
}  // namespace bleedsim::recording::test
