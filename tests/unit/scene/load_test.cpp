#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "scene_text.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::scene {
namespace {

using testing::HasSubstr;

const std::filesystem::path kScenes{BLEEDSIM_SCENE_DIR};

/// A file of this test, removed with it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path{testing::TempDir()} / (std::string{"bleedsim_"} + test->test_suite_name() + "_" + test->name());
    std::ofstream{path_, std::ios::binary} << content;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(LoadScene, EveryShippedSceneIsValidAndNamedLikeItsFile) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator{kScenes}) {
    ++scenes;
    const Result<SceneDescription> scene = loadScene(entry.path());
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    EXPECT_EQ(scene->name, entry.path().stem().string());
    EXPECT_FALSE(scene->description.empty());
    EXPECT_TRUE(scene->world.effects.applied_force.has_value()) << "each shipped scene takes forces and commands";
    EXPECT_FALSE(scene->world.wounds.empty());
    EXPECT_NE(scene->attributes & sph::kFrameVelocity, 0u) << entry.path();
  }
  EXPECT_GE(scenes, 4);
}

TEST(LoadScene, RoundWoundLeavesRoomForAFurtherWound) {
  const Result<SceneDescription> scene = loadScene(kScenes / "round_wound.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const sph::WorldDescription& world = scene->world;
  EXPECT_EQ(world.spacing, 0.003);
  EXPECT_EQ(world.compressibility.design_speed, 0.3);
  EXPECT_LE(world.domain.lower.head<2>().maxCoeff(), -0.05);
  EXPECT_GE(world.domain.upper.head<2>().minCoeff(), 0.05);
  ASSERT_EQ(world.wounds.size(), 1u);
  EXPECT_TRUE(world.wounds[0].position.isZero());
  const double own = std::get<sph::FlowDrive>(world.wounds[0].drive).flow;
  const double needed = (own * 60.0 + 2e-6 * 10.0) / world.particleVolume();
  EXPECT_GE(world.capacity, needed);
  EXPECT_LT(world.domain.lower.z(), -(world.supportRadius() + world.spacing)) << "the throat needs room below the tissue";
}

TEST(LoadScene, TheFineSceneHoldsThePapersCount) {
  const Result<SceneDescription> scene = loadScene(kScenes / "round_wound_20k.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  EXPECT_EQ(scene->world.spacing, 0.001);
  EXPECT_GE(scene->world.capacity, 24'000u);
}

TEST(LoadScene, TheIncisionLiesAtTheBottomOfTheBowl) {
  const Result<SceneDescription> scene = loadScene(kScenes / "incision.textproto");
  ASSERT_TRUE(scene.ok()) << scene.status().message();
  const auto& bowl = std::get<sph::BowlShape>(scene->world.tissue.at(0).shape);
  const sph::Vec3 bottom = bowl.rim_center - sph::Vec3{0.0, 0.0, bowl.depth};
  EXPECT_TRUE(scene->world.wounds.at(0).position.isApprox(bottom, 1e-12));
  EXPECT_TRUE(std::holds_alternative<sph::PolylinePatch>(scene->world.wounds[0].shape));
}

TEST(LoadScene, AMissingFileNamesItsPathAndTheRemedy) {
  const Status status = loadScene("/nowhere/at_all.textproto").status();
  EXPECT_EQ(status.code(), StatusCode::not_found);
  EXPECT_THAT(status.message(), HasSubstr("'/nowhere/at_all.textproto': does not exist; give the path of a scene file"));
}

TEST(LoadScene, AFolderIsRefused) {
  const Status status = loadScene(kScenes).status();
  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr("is a folder"));
}

TEST(LoadScene, ADeviceIsRefused) {
  EXPECT_THAT(loadScene("/dev/zero").status().message(), HasSubstr("'/dev/zero': is not a regular file"));
}

TEST(LoadScene, AFileBeyondTheLimitIsRefused) {
  const TemporaryFile file{std::string(kMaxSceneBytes + 1, '\n')};
  const Status status = loadScene(file.path()).status();
  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr("is larger than 1048576 bytes"));
}

TEST(LoadScene, AFileOfExactlyTheLimitIsRead) {
  std::string text{kLeastScene};
  text.resize(kMaxSceneBytes, '\n');
  const TemporaryFile file{text};
  const Result<SceneDescription> scene = loadScene(file.path());
  EXPECT_TRUE(scene.ok()) << scene.status().message();
}

TEST(LoadScene, AnInvalidFileNamesItsPathBeforeItsProblems) {
  const TemporaryFile file{"seed: x"};
  const Status status = loadScene(file.path()).status();
  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_THAT(status.message(), HasSubstr(file.path().string()));
  EXPECT_THAT(status.message(), HasSubstr("line 1:7: "));
}

}  // namespace
}  // namespace bleedsim::scene
