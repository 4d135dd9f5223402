// The files for ParaView.
#include "service/recording/export.h"

#include <cstring>
#include <gtest/gtest.h>
#include <regex>

#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

TEST(Export, AppendedBlocksLieWhereTheHeaderSays) {
  std::mt19937_64 random{3};
  const Frame frame = makeFrame(random, 1, 17);
  auto vtp = toVtp(frame);
  ASSERT_TRUE(vtp.ok()) << vtp.status().message();
  const std::size_t base = vtp->find("encoding=\"raw\">\n_") + std::strlen("encoding=\"raw\">\n_");
  ASSERT_LT(base, vtp->size());
  const std::string head = vtp->substr(0, base);
  EXPECT_NE(head.find("NumberOfPoints=\"17\""), std::string::npos);
  const std::regex declaration{R"re(type="(\w+)" Name="(\w+)" NumberOfComponents="(\d+)" format="appended" offset="(\d+)")re"};
  std::size_t end = 0;
  int arrays = 0;
  for (std::sregex_iterator it{head.begin(), head.end(), declaration}, last; it != last; ++it, ++arrays) {
    const std::size_t scalar = (*it)[1] == "Int64" ? 8 : 4;
    const std::size_t expected = 17 * std::stoul((*it)[3]) * scalar;
    const std::size_t offset = std::stoul((*it)[4]);
    EXPECT_EQ(offset, end);
    std::uint64_t size = 0;
    std::memcpy(&size, vtp->data() + base + offset, sizeof size);
    EXPECT_EQ(size, expected) << (*it)[2];
    if ((*it)[2] == "position") { EXPECT_EQ(vtp->substr(base + offset + 8, size), frame.payload().substr(0, size)); }
    if ((*it)[2] == "velocity") {
      std::uint16_t stored = 0;
      std::memcpy(&stored, frame.payload().data() + 17 * 16, sizeof stored);
      float value = 0.0F;
      std::memcpy(&value, vtp->data() + base + offset + 8, sizeof value);
      EXPECT_FLOAT_EQ(value, -1.0F + 0.5F * static_cast<float>(stored));
    }
    end = offset + 8 + size;
  }
  EXPECT_EQ(arrays, 5);
  EXPECT_EQ(vtp->substr(base + end), "\n</AppendedData>\n</VTKFile>\n");
}

TEST(Export, NamesEveryAttribute) {
  std::mt19937_64 random{5};
  Frame frame = makeFrame(random, 1, 3);
  for (const Attribute::Semantic semantic : {Attribute::PLATELET, Attribute::RADIUS, Attribute::VISCOSITY, Attribute::DENSITY}) {
    Attribute& attribute = *frame.add_attributes();
    attribute.set_semantic(semantic);
    attribute.set_components(1);
    frame.mutable_payload()->append(12, '\0');
  }
  auto vtp = toVtp(frame);
  ASSERT_TRUE(vtp.ok()) << vtp.status().message();
  for (const char* name : {"platelet", "radius", "viscosity", "density"}) {
    EXPECT_NE(vtp->find("Name=\"" + std::string{name} + "\""), std::string::npos) << name;
  }
}

TEST(Export, WritesEveryFrameAndTheCollection) {
  const ScratchFile file{"export.mcap"};
  const ScratchFile directory{"export"};
  writeRecording(file.path(), 12, 3000);
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  auto report = exportVtp(*reader, directory.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(report->frames, 12U);
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "frame_000000.vtp"));
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "frame_000011.vtp"));
  const std::string collection = readAll(report->collection);
  EXPECT_NE(collection.find("timestep=\"0.2\" part=\"0\" file=\"frame_000011.vtp\""), std::string::npos) << collection;
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator{directory.path()}) bytes += entry.file_size();
  EXPECT_EQ(bytes, report->bytes);
}

TEST(Export, StopsWhenAskedAndNamesWhatCannotBeWritten) {
  const ScratchFile file{"export_stop.mcap"};
  const ScratchFile directory{"export_stop"};
  writeRecording(file.path(), 12, 3000);
  auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader.ok());
  auto report = exportVtp(*reader, directory.path(), [](std::size_t done, std::size_t) { return done < 4; });
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->frames, 4U);
  auto refused = exportVtp(*reader, file.path() / "below_a_file");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.status().code(), StatusCode::io);
}

TEST(Export, FramesThatContradictThemselvesAreDataLoss) {
  std::mt19937_64 random{5};
  Frame frame = makeFrame(random, 1, 4);
  frame.mutable_payload()->pop_back();
  EXPECT_EQ(toVtp(frame).status().code(), StatusCode::data_loss);
  frame = makeFrame(random, 1, 4);
  frame.set_count(4'000'000'000U);
  EXPECT_EQ(toVtp(frame).status().code(), StatusCode::data_loss);
  frame = makeFrame(random, 1, 4);
  frame.mutable_attributes(0)->set_semantic(Attribute::VELOCITY);
  EXPECT_EQ(toVtp(frame).status().code(), StatusCode::data_loss);
}

}  // namespace
}  // namespace bleedsim::recording::test
