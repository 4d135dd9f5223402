// The files for other programs.
#include "service/recording/export.h"

#include <array>
#include <cstring>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <regex>

#include "service/recording/convert.h"
#include "service/recording/ply.h"
#include "service/recording/recording_writer.h"
#include "service/recording/vtp.h"
#include "tests/support/frame_block.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

namespace fs = std::filesystem;

bool afterFour(std::size_t done, std::size_t /*total*/) { return done < 4; }

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
  auto report = exportRecording(file.path(), ExportFormat::vtp, directory.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(report->frames, 12U);
  EXPECT_TRUE(report->whole);
  EXPECT_TRUE(report->truncation_reason.empty());
  EXPECT_TRUE(fs::exists(directory.path() / "frame_000000.vtp"));
  EXPECT_TRUE(fs::exists(directory.path() / "frame_000011.vtp"));
  const std::string collection = readAll(report->output);
  EXPECT_NE(collection.find("timestep=\"0.2\" part=\"0\" file=\"frame_000011.vtp\""), std::string::npos) << collection;
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::directory_iterator{directory.path()}) bytes += entry.file_size();
  EXPECT_EQ(bytes, report->bytes);
}

TEST(Export, StopsWhenAskedAndNamesWhatCannotBeWritten) {
  const ScratchFile file{"export_stop.mcap"};
  const ScratchFile directory{"export_stop"};
  writeRecording(file.path(), 12, 3000);
  auto report = exportRecording(file.path(), ExportFormat::vtp, directory.path(), {}, afterFour);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->frames, 4U);
  EXPECT_FALSE(report->whole);
  for (const ExportFormat format : {ExportFormat::vtp, ExportFormat::ply, ExportFormat::csv, ExportFormat::mcap_point_cloud}) {
    auto refused = exportRecording(file.path(), format, file.path() / "below_a_file");
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.status().code(), StatusCode::io) << refused.status().message();
    EXPECT_NE(refused.status().message().find("below_a_file"), std::string::npos) << refused.status().message();
  }
  EXPECT_EQ(exportRecording(file.path(), ExportFormat::ply, file.path()).status().code(), StatusCode::io);
}

TEST(Export, OneFileReplacesAnotherOnlyWhenItIsWhole) {
  const ScratchFile file{"export_one.mcap"};
  const ScratchFile folder{"export_one"};
  fs::create_directory(folder.path());
  const fs::path out = folder.path() / "out";
  writeRecording(file.path(), 12, 3000);
  for (const ExportFormat format : {ExportFormat::csv, ExportFormat::mcap_point_cloud}) {
    writeAll(out, "before");
    auto report = exportRecording(file.path(), format, out, {}, afterFour);
    ASSERT_TRUE(report.ok());
    EXPECT_FALSE(report->whole);
    EXPECT_EQ(readAll(out), "before");
    report = exportRecording(file.path(), format, out);
    ASSERT_TRUE(report.ok()) << report.status().message();
    EXPECT_EQ(report->output, out);
    EXPECT_EQ(report->bytes, fs::file_size(out));
    EXPECT_GT(report->bytes, 1000U);
    EXPECT_EQ(exportRecording(file.path(), format, file.path()).status().code(), StatusCode::invalid_argument);
    EXPECT_EQ(exportRecording(file.path(), format, folder.path()).status().code(), StatusCode::invalid_argument);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator{folder.path()}, {}), 1) << "no half files stay behind";
}

TEST(Export, FormatsAreKnownByName) {
  for (const char* name : {"vtp", "ply", "csv", "mcap-pointcloud"}) EXPECT_TRUE(parseExportFormat(name).ok()) << name;
  const auto unknown = parseExportFormat("alembic");
  EXPECT_EQ(unknown.status().code(), StatusCode::invalid_argument);
  EXPECT_NE(unknown.status().message().find("vtp, ply, csv, mcap-pointcloud"), std::string::npos);
}

TEST(Export, TakesTheFramesThatAreAskedFor) {
  using Numbers = std::vector<std::size_t>;
  const auto each = [](std::size_t every) { return FrameSelection{.frame = {}, .every = every}; };
  EXPECT_EQ(*selectFrames({}, 3), (Numbers{0, 1, 2}));
  EXPECT_EQ(*selectFrames(each(3), 7), (Numbers{0, 3, 6}));
  EXPECT_EQ(*selectFrames(each(std::numeric_limits<std::size_t>::max()), 7), (Numbers{0}));
  EXPECT_EQ(*selectFrames({.frame = 6}, 7), (Numbers{6}));
  const auto beyond = selectFrames({.frame = 7}, 7);
  EXPECT_EQ(beyond.status().code(), StatusCode::invalid_argument);
  EXPECT_NE(beyond.status().message().find("has 7, numbered 0 to 6"), std::string::npos) << beyond.status().message();
  EXPECT_EQ(selectFrames({}, 0).status().code(), StatusCode::not_found);
  EXPECT_EQ(selectFrames(each(0), 7).status().code(), StatusCode::invalid_argument);

  const ScratchFile file{"export_some.mcap"};
  const ScratchFile directory{"export_some"};
  writeRecording(file.path(), 12, 3000);
  auto report = exportRecording(file.path(), ExportFormat::ply, directory.path(), each(5));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->frames, 3U);
  for (const char* name : {"frame_000000.ply", "frame_000005.ply", "frame_000010.ply"}) {
    EXPECT_TRUE(fs::exists(directory.path() / name)) << name;
  }
}

TEST(Export, PlyHoldsTheNumbersThatItsHeaderDeclares) {
  std::mt19937_64 random{7};
  const Frame frame = makeFrame(random, 9, 17);
  const auto ply = toPly(frame);
  ASSERT_TRUE(ply.ok()) << ply.status().message();
  const std::string end = "end_header\n";
  const std::size_t data = ply->find(end) + end.size();
  EXPECT_EQ(ply->substr(0, 36), "ply\nformat binary_little_endian 1.0\n");
  EXPECT_EQ(ply->substr(0, data).substr(ply->find("element")),
            "element vertex 17\nproperty float x\nproperty float y\nproperty float z\nproperty uint id\nproperty float vx\n"
            "property float vy\nproperty float vz\nend_header\n");
  ASSERT_EQ(ply->size() - data, 17U * 28U);
  for (std::size_t i = 0; i < 17; ++i) {
    const std::string point = ply->substr(data + i * 28, 28);
    EXPECT_EQ(point.substr(0, 12), frame.payload().substr(i * 12, 12));
    EXPECT_EQ(point.substr(12, 4), frame.payload().substr(17 * 12 + i * 4, 4));
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint16_t stored = 0;
      std::memcpy(&stored, frame.payload().data() + 17 * 16 + i * 6 + c * 2, sizeof stored);
      float value = 0.0F;
      std::memcpy(&value, point.data() + 16 + c * 4, sizeof value);
      EXPECT_EQ(value, -1.0F + 0.5F * static_cast<float>(stored));
    }
  }
}

/// Two particles; `with_density`: as a session that was told to publish more.
Frame tableFrame(std::uint64_t seq, bool with_density) {
  Frame frame;
  frame.set_session("0123456789abcdef");
  frame.set_seq(seq);
  frame.set_epoch(2);
  frame.set_sim_time_s(0.25 * static_cast<double>(seq));
  frame.set_count(2);
  addBlock(frame, Attribute::POSITION, Attribute::FLOAT32, 3, std::array<float, 6>{0.1F, 0.2F, -0.3F, 1e-7F, 2.0F, 3.0F});
  addBlock(frame, Attribute::ID, Attribute::UINT32, 1, std::array<std::uint32_t, 2>{4'000'000'000U, 7});
  if (with_density) addBlock(frame, Attribute::DENSITY, Attribute::FLOAT32, 1, std::array<float, 2>{1060.0F, 1061.5F});
  return frame;
}

TEST(Export, CsvIsOneTableWithAllColumnsOfAllFrames) {
  const ScratchFile file{"export_csv.mcap"};
  const ScratchFile table{"export.csv"};
  auto writer = RecordingWriter::open(file.path());
  ASSERT_TRUE(writer.ok());
  ASSERT_TRUE(writer->append(**fromRecording(tableFrame(1, false))).ok());
  ASSERT_TRUE(writer->append(**fromRecording(tableFrame(2, true))).ok());
  ASSERT_TRUE(writer->close().ok());
  const auto report = exportRecording(file.path(), ExportFormat::csv, table.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(readAll(table.path()),
            "frame,epoch,time_s,id,x,y,z,density\n"
            "0,2,0.25,4000000000,0.1,0.2,-0.3,\n"
            "0,2,0.25,7,1e-07,2,3,\n"
            "1,2,0.5,4000000000,0.1,0.2,-0.3,1060\n"
            "1,2,0.5,7,1e-07,2,3,1061.5\n");
}

TEST(Export, ACutOffRecordingGivesWhatItHoldsAndSaysSo) {
  const ScratchFile file{"export_cut.mcap"};
  const ScratchFile directory{"export_cut"};
  writeRecording(file.path(), 60, 3000);
  const std::string whole = readAll(file.path());
  writeAll(file.path(), whole.substr(0, whole.size() * 2 / 3));
  const auto report = exportRecording(file.path(), ExportFormat::ply, directory.path());
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_GT(report->frames, 10U);
  EXPECT_LT(report->frames, 60U);
  EXPECT_FALSE(report->truncation_reason.empty());
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
