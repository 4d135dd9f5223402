// Pictures of a recording: the scene's tissue, one camera for all frames, colours by what the frames hold.
#include "clients/bleedctl/frame_painter.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/bleedctl/tissue_shapes.h"
#include "service/recording/convert.h"
#include "service/recording/recording_writer.h"
#include "service/recording/scene_text.h"
#include "tests/support/frame_block.h"

namespace bleedsim::bleedctl {
namespace {

using recording::Attribute;
using testing::HasSubstr;

constexpr const char* kTissue =
    "tissue { name: \"skin\" plane { point_m { z: 0.5 } normal { z: 2 } } }\n"
    "tissue { box { lower_m { x: -1 } upper_m { x: 1 y: 2 z: 3 } side: OBSTACLE } from_a_later_version: 7 }\n"
    "tissue { bowl { rim_center_m { y: 1 } sphere_radius_m: 0.3 depth_m: 0.1 } }\n"
    "tissue { bowl { sphere_radius_m: 0.1 depth_m: 0.3 } }\n"
    "tissue { name: \"shapeless\" }\n";

TEST(TissueShapes, AreThoseOfTheSceneText) {
  const auto scene = recording::readSceneText(kTissue);
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const std::vector<picture::Shape> shapes = tissueShapes(*scene);
  ASSERT_EQ(shapes.size(), 3U) << "what makes no shape is left out";
  const auto& plane = std::get<picture::PlaneShape>(shapes[0]);
  EXPECT_EQ(plane.point.z(), 0.5);
  EXPECT_EQ(plane.normal.z(), 2.0);
  const auto& box = std::get<picture::BoxShape>(shapes[1]);
  EXPECT_EQ(box.lower.x(), -1.0);
  EXPECT_EQ(box.upper.z(), 3.0);
  EXPECT_FALSE(box.container);
  const auto& bowl = std::get<picture::BowlShape>(shapes[2]);
  EXPECT_EQ(bowl.rim_center.y(), 1.0);
  EXPECT_EQ(bowl.sphere_radius_m, 0.3);
  EXPECT_EQ(bowl.depth_m, 0.1);
  EXPECT_EQ(recording::readSceneText("tissue {").status().code(), StatusCode::data_loss);
}

class FramePainterTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  /// `scene`: text of a scene; null: the recording has none.
  void write(const char* scene, const std::vector<std::vector<float>>& frames) {
    auto writer = recording::RecordingWriter::open(path_);
    ASSERT_TRUE(writer.ok()) << writer.status().message();
    if (scene != nullptr) {
      recording::Scene message;
      message.set_session(kSession);
      message.set_epoch(1);
      message.set_scene_text(scene);
      message.set_spacing_m(0.004);
      message.mutable_lower_bound()->set_x(-0.1);
      message.mutable_upper_bound()->set_z(0.1);
      ASSERT_TRUE(writer->append(**recording::fromRecording(message)).ok());
    }
    std::uint64_t seq = 0;
    for (const std::vector<float>& positions : frames) {
      ASSERT_TRUE(writer->append(**recording::fromRecording(frameOf(++seq, positions))).ok());
    }
    ASSERT_TRUE(writer->close().ok());
    auto reader = recording::RecordingReader::open(path_);
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    reader_.emplace(std::move(*reader));
  }

  static recording::Frame frameOf(std::uint64_t seq, const std::vector<float>& positions) {
    recording::Frame frame;
    frame.set_session(kSession);
    frame.set_epoch(1);
    frame.set_seq(seq);
    frame.set_count(static_cast<std::uint32_t>(positions.size() / 3));
    recording::test::addBlock(frame, Attribute::POSITION, Attribute::FLOAT32, 3, positions);
    recording::test::addBlock(frame, Attribute::ID, Attribute::UINT32, 1, std::vector<std::uint32_t>(frame.count(), 1));
    recording::test::addBlock(frame, Attribute::VELOCITY, Attribute::FLOAT32, 3, positions);
    return frame;
  }

  Result<FramePainter> painter(const std::vector<std::size_t>& frames, const std::string& color_by = {}) {
    PaintOptions options;
    options.width = 120;
    options.height = 90;
    options.look = picture::BloodLook::spheres;
    options.view = picture::NamedView::front;
    options.color_by = color_by;
    return FramePainter::create(*reader_, frames, options);
  }

  /// Pixels that are different.
  static int difference(const picture::Image& a, const picture::Image& b) {
    int count = 0;
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) count += a.at(x, y) == b.at(x, y) ? 0 : 1;
    }
    return count;
  }

  static constexpr const char* kSession = "0123456789abcdef";
  std::filesystem::path path_ =
      std::filesystem::path{testing::TempDir()} / ("frame_painter_" + std::to_string(::getpid()) + ".mcap");
  std::optional<recording::RecordingReader> reader_;
};

const std::vector<float> kLeft{-0.02F, 0.0F, 0.01F};
const std::vector<float> kBoth{-0.02F, 0.0F, 0.01F, 0.02F, 0.0F, 0.01F};

TEST_F(FramePainterTest, AllFramesAreSeenFromOnePlace) {
  write("", {kLeft, kBoth});
  auto painter_of_both = painter({0, 1});
  ASSERT_TRUE(painter_of_both.ok()) << painter_of_both.status().message();
  EXPECT_TRUE(painter_of_both->warning().empty()) << painter_of_both->warning();
  const auto first = painter_of_both->paint(*reader_, 0);
  const auto second = painter_of_both->paint(*reader_, 1);
  ASSERT_TRUE(first.ok() && second.ok());
  // The left particle stands where it stood; the right half gets another. The upper quarter holds the caption.
  int left = 0;
  int right = 0;
  for (int y = 23; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) (x < 60 ? left : right) += first->at(x, y) == second->at(x, y) ? 0 : 1;
  }
  EXPECT_EQ(left, 0);
  EXPECT_GT(right, 20);
  // Alone the first frame is seen from nearer.
  auto alone = painter({0});
  ASSERT_TRUE(alone.ok());
  EXPECT_GT(difference(*alone->paint(*reader_, 0), *first), 100);
}

TEST_F(FramePainterTest, TheTissueIsDrawn) {
  write("", {kBoth});
  const auto bare = painter({0})->paint(*reader_, 0);
  write("tissue { plane { point_m { z: 0.005 } normal { z: 1 } } }", {kBoth});
  const auto with_tissue = painter({0})->paint(*reader_, 0);
  ASSERT_TRUE(bare.ok() && with_tissue.ok());
  EXPECT_GT(difference(*bare, *with_tissue), 1000);
}

TEST_F(FramePainterTest, WhatIsMissingIsSaid) {
  write("tissue {", {kBoth});
  auto without_tissue = painter({0});
  ASSERT_TRUE(without_tissue.ok());
  EXPECT_THAT(without_tissue->warning(), HasSubstr("without tissue"));
  write(nullptr, {kBoth});
  auto without_scene = painter({0});
  ASSERT_TRUE(without_scene.ok());
  EXPECT_THAT(without_scene->warning(), HasSubstr("holds no scene"));
  EXPECT_TRUE(without_scene->paint(*reader_, 0).ok());
  write(nullptr, {{}});
  EXPECT_EQ(painter({0}).status().code(), StatusCode::not_found);
  write("", {{}});
  auto empty = painter({0});
  ASSERT_TRUE(empty.ok()) << "the scene's box is shown before the first drop";
  EXPECT_TRUE(empty->paint(*reader_, 0).ok());
}

TEST_F(FramePainterTest, ColoursComeFromTheFrame) {
  write("", {kBoth});
  auto by_speed = painter({0}, "speed");
  ASSERT_TRUE(by_speed.ok()) << by_speed.status().message();
  EXPECT_GT(difference(*by_speed->paint(*reader_, 0), *painter({0})->paint(*reader_, 0)), 50);
  for (const char* missing : {"density", "beauty"}) {
    const auto refused = painter({0}, missing);
    EXPECT_EQ(refused.status().code(), StatusCode::invalid_argument);
    EXPECT_THAT(refused.status().message(), HasSubstr("there is speed"));
  }
}

}  // namespace
}  // namespace bleedsim::bleedctl
