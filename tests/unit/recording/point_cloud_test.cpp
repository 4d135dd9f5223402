// foxglove.PointCloud: the message, its channel in a recording, and the file made of one.
#include "service/recording/point_cloud.h"

#include <cstring>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>
#include <set>

#include "service/recording/convert.h"
#include "service/recording/export.h"
#include "service/recording/frame_columns.h"
#include "service/recording/mcap_reader.h"
#include "service/recording/recording_writer.h"
#include "service/recording/recover.h"
#include "tests/unit/recording/random_samples.h"

namespace bleedsim::recording::test {
namespace {

using Field = foxglove::PackedElementField;

float floatAt(const foxglove::PointCloud& cloud, std::size_t point, const std::string& name) {
  for (const Field& field : cloud.fields()) {
    if (field.name() != name) continue;
    EXPECT_EQ(field.type(), Field::FLOAT32) << name;
    float value = 0.0F;
    std::memcpy(&value, cloud.data().data() + point * cloud.point_stride() + field.offset(), sizeof value);
    return value;
  }
  ADD_FAILURE() << "no field " << name;
  return 0.0F;
}

void expectSamePoints(const foxglove::PointCloud& cloud, const Frame& frame) {
  FrameColumns columns;
  ASSERT_TRUE(toColumns(frame, columns).ok());
  ASSERT_EQ(cloud.data().size(), std::size_t{frame.count()} * cloud.point_stride());
  ASSERT_EQ(cloud.fields(3).name(), "id");
  EXPECT_EQ(cloud.fields(3).type(), Field::UINT32);
  const std::map<std::string, std::string> names{{"x", "x"},           {"y", "y"},           {"z", "z"},
                                                 {"vx", "velocity_x"}, {"vy", "velocity_y"}, {"vz", "velocity_z"}};
  for (std::size_t i = 0; i < frame.count(); ++i) {
    std::uint32_t id = 0;
    std::memcpy(&id, cloud.data().data() + i * cloud.point_stride() + 12, sizeof id);
    EXPECT_EQ(id, columns.ids[i]);
    for (const auto& column : columns.columns) {
      const float stored = floatAt(cloud, i, names.at(column.name));
      EXPECT_EQ(std::memcmp(&stored, &column.values[i], sizeof stored), 0) << column.name;
    }
  }
}

TEST(PointCloud, HoldsWhatTheFrameHolds) {
  std::mt19937_64 random{5};
  Frame frame = makeFrame(random, 3, 40);
  frame.set_realtime_stamp_ns(1'700'000'000'123'456'789);
  foxglove::PointCloud cloud;
  ASSERT_TRUE(toPointCloud(frame, "theatre", cloud).ok());
  EXPECT_EQ(cloud.frame_id(), "theatre");
  EXPECT_EQ(cloud.timestamp().seconds(), 1'700'000'000);
  EXPECT_EQ(cloud.timestamp().nanos(), 123'456'789);
  EXPECT_EQ(cloud.pose().orientation().w(), 1.0);
  EXPECT_EQ(cloud.point_stride(), 32U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(cloud.fields(i).name(), std::string(1, "xyz"[i]));
    EXPECT_EQ(cloud.fields(i).offset(), 4U * static_cast<unsigned>(i));
  }
  expectSamePoints(cloud, frame);
  const float vx = floatAt(cloud, 7, "velocity_x");
  const float vy = floatAt(cloud, 7, "velocity_y");
  const float vz = floatAt(cloud, 7, "velocity_z");
  EXPECT_FLOAT_EQ(floatAt(cloud, 7, "speed"), std::sqrt(vx * vx + vy * vy + vz * vz));

  ASSERT_TRUE(toPointCloud(frame, "", cloud).ok());
  EXPECT_EQ(cloud.frame_id(), kDefaultFrameId);
  frame.mutable_payload()->pop_back();
  EXPECT_EQ(toPointCloud(frame, "theatre", cloud).code(), StatusCode::data_loss);
}

TEST(PointCloud, TheSchemaHoldsAllItsImportsInOrder) {
  const mcap::Schema schema = pointCloudSchema(6);
  EXPECT_EQ(schema.name, "foxglove.PointCloud");
  EXPECT_EQ(schema.encoding, "protobuf");
  google::protobuf::FileDescriptorSet set;
  ASSERT_TRUE(set.ParseFromString(schema.data));
  std::set<std::string> seen;
  std::set<std::string> messages;
  for (const auto& file : set.file()) {
    for (const std::string& dependency : file.dependency()) EXPECT_TRUE(seen.contains(dependency)) << dependency;
    seen.insert(file.name());
    for (const auto& message : file.message_type()) messages.insert(file.package() + "." + message.name());
  }
  EXPECT_EQ(messages, (std::set<std::string>{"foxglove.PackedElementField", "foxglove.PointCloud", "foxglove.Pose",
                                             "foxglove.Quaternion", "foxglove.Vector3", "google.protobuf.Timestamp"}));
}

/// The clouds of a file, in order.
std::vector<foxglove::PointCloud> cloudsOf(const std::filesystem::path& path) {
  std::vector<foxglove::PointCloud> out;
  auto file = mcap::McapReader::open(path);
  EXPECT_TRUE(file.ok()) << file.status().message();
  EXPECT_TRUE(file->verify().ok());
  for (std::size_t chunk = 0; chunk < file->index().chunks.size(); ++chunk) {
    EXPECT_TRUE(file->loadChunk(chunk).ok());
    std::uint64_t position = 0;
    mcap::Message message;
    for (auto more = file->next(position, message); more.ok() && *more; more = file->next(position, message)) {
      if (file->index().channels.at(message.head.channel_id).topic != kPointCloudChannel) continue;
      out.emplace_back();
      EXPECT_TRUE(out.back().ParseFromArray(message.data.data(), static_cast<int>(message.data.size())));
    }
  }
  return out;
}

class PointCloudFile : public testing::Test {
 protected:
  void write(bool point_cloud) {
    std::mt19937_64 random{8};
    WriterOptions options;
    options.point_cloud = point_cloud;
    options.quantize16 = point_cloud;
    options.chunk_bytes = 8000;
    auto writer = RecordingWriter::open(file_.path(), options);
    ASSERT_TRUE(writer.ok());
    Scene scene = makeScene(random);
    scene.set_frame_id("theatre");
    ASSERT_TRUE(writer->append(**fromRecording(scene)).ok());
    for (std::uint64_t seq = 1; seq <= 9; ++seq) {
      frames_.push_back(makeFrame(random, seq, 60));
      ASSERT_TRUE(writer->append(**fromRecording(frames_.back())).ok());
      ASSERT_TRUE(writer->append(**fromRecording(makeStats(seq, 0.1))).ok());
    }
    ASSERT_TRUE(writer->close().ok());
  }

  ScratchFile file_{"clouds.mcap"};
  ScratchFile other_{"clouds_other.mcap"};
  std::vector<Frame> frames_;
};

TEST_F(PointCloudFile, ARecordingHoldsEachFrameAgain) {
  write(true);
  auto clouds = cloudsOf(file_.path());
  ASSERT_EQ(clouds.size(), frames_.size());
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].frame_id(), "theatre");
    expectSamePoints(clouds[i], frames_[i]);
  }
  auto reader = RecordingReader::open(file_.path());
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(*reader->frameCount(), frames_.size());

  ASSERT_TRUE(recover(file_.path(), other_.path()).ok());
  EXPECT_EQ(cloudsOf(other_.path()).size(), frames_.size());
}

TEST_F(PointCloudFile, AnExportHoldsThemInPlaceOfTheFrames) {
  write(false);
  EXPECT_TRUE(cloudsOf(file_.path()).empty());
  const auto report = exportRecording(file_.path(), ExportFormat::mcap_point_cloud, other_.path(), {.every = 4});
  ASSERT_TRUE(report.ok()) << report.status().message();
  EXPECT_EQ(report->frames, 3U);
  const auto clouds = cloudsOf(other_.path());
  ASSERT_EQ(clouds.size(), 3U);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].frame_id(), "theatre");
    expectSamePoints(clouds[i], frames_[4 * i]);
  }
  auto reader = RecordingReader::open(other_.path());
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  EXPECT_EQ(*reader->frameCount(), 0U);
  std::size_t stats = 0;
  RecordedMessage message;
  for (auto more = reader->next(message); more.ok() && *more; more = reader->next(message)) {
    if (message.topic == Topic::frame_stats) ++stats;
  }
  EXPECT_EQ(stats, frames_.size());
}

}  // namespace
}  // namespace bleedsim::recording::test
