// What a world needs is compared with what there is before it is reserved.
#include "service/sph/memory_need.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "service/sph/world.h"

namespace bleedsim::sph {
namespace {

using testing::HasSubstr;

WorldDescription box(std::uint32_t capacity, double support_ratio) {
  WorldDescription d;
  d.domain.lower = {-0.05, -0.05, -0.05};
  d.domain.upper = {0.05, 0.05, 0.05};
  d.capacity = capacity;
  d.spacing = 0.002;
  d.support_ratio = support_ratio;
  d.rest_density = 1060.0;
  d.compressibility = {10.0, 0.3, 0.0};
  d.effects.pressure.emplace();
  d.effects.viscosity.emplace();
  return d;
}

/// The bound is meant for every effect and for frames, which take up to about as much again as a plain world; more than three
/// times as much would refuse scenes that fit.
TEST(MemoryNeed, BoundsWhatAWorldReserves) {
  for (const double support_ratio : {1.5, 2.0, 3.0, 3.5}) {
    for (const bool every : {false, true}) {
      WorldDescription d = box(50'000, support_ratio);
      if (every) {
        d.effects.gravity.emplace();
        d.effects.surface_tension.emplace();
        d.effects.platelets.emplace();
        d.effects.viscosity->solve = ViscositySolve::implicit;
      }
      const auto world = createWorld(d, {.threads = 1});
      ASSERT_TRUE(world.ok()) << world.status().message();
      const MemoryUse use = (*world)->memory();
      const auto reserved = static_cast<double>(use.particles + use.passes + use.lists + use.grid + use.tissue + use.effects);
      const auto need = static_cast<double>(memoryNeed(d, 1));
      EXPECT_GT(need, reserved) << support_ratio << (every ? " every effect" : "");
      EXPECT_LT(need, 3.0 * reserved) << support_ratio << (every ? " every effect" : "");
    }
  }
}

TEST(CheckMemory, RefusesWithBothFiguresAndWhatToDo) {
  const WorldDescription d = box(2'000'000, 2.0);
  EXPECT_TRUE(checkMemory(d, 2, std::nullopt).ok()) << "a system that does not tell";
  EXPECT_TRUE(checkMemory(d, 2, memoryNeed(d, 2)).ok());
  const Status refused = checkMemory(d, 2, std::uint64_t{512} << 20U);
  EXPECT_EQ(refused.code(), StatusCode::capacity);
  EXPECT_THAT(refused.message(), HasSubstr("a capacity of 2000000 particles needs 1"));
  EXPECT_THAT(refused.message(), HasSubstr("512 MiB are available: lower domain.capacity"));
}

class AvailableMemory : public testing::Test {
 protected:
  void SetUp() override { write("proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    4000 kB\n"); }
  void TearDown() override { std::filesystem::remove_all(root_); }
  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream{root_ / file} << text;
  }

  std::filesystem::path root_ = std::filesystem::path{testing::TempDir()} / ("memory_need_" + std::to_string(getpid()));
};

TEST_F(AvailableMemory, IsTheMachines) { EXPECT_EQ(availableMemory(root_), 4000U * 1024); }

TEST_F(AvailableMemory, IsWhatTheTightestGroupLeaves) {
  write("proc/self/cgroup", "1:name=old:/x\n0::/outer/inner\n");
  write("sys/fs/cgroup/outer/inner/memory.max", "max\n");
  write("sys/fs/cgroup/outer/inner/memory.current", "1000\n");
  EXPECT_EQ(availableMemory(root_), 4000U * 1024) << "no limit";
  write("sys/fs/cgroup/outer/memory.max", "1000000\n");
  write("sys/fs/cgroup/outer/memory.current", "400000\n");
  EXPECT_EQ(availableMemory(root_), 600'000U) << "of the group around it";
  write("sys/fs/cgroup/outer/inner/memory.max", "900\n");
  EXPECT_EQ(availableMemory(root_), 0U) << "more is used than allowed";
}

TEST_F(AvailableMemory, IsUnknownWithoutProc) { EXPECT_EQ(availableMemory(root_ / "nowhere"), std::nullopt); }

TEST_F(AvailableMemory, OfThisMachineIsMoreThanNothing) { EXPECT_GT(availableMemory().value_or(1), 0U); }

}  // namespace
}  // namespace bleedsim::sph
