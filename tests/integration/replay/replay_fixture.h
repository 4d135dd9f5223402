// Daemons on a scene of their own, in a folder that is gone after the test.
#pragma once

#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include "tests/integration/client/running_daemon.h"

namespace bleedsim::replay_test {

inline constexpr std::uint32_t kDomain = 62;

class ReplayFixture : public testing::Test {
 protected:
  void SetUp() override {
    client_test::isolate();
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    session_ = fmt::format("{}-{}", test, getpid());
    folder_ = std::filesystem::path{testing::TempDir()} / session_;
    std::filesystem::create_directories(folder_);
    std::ofstream{sceneFile()} << sceneText();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Bleeding into a pool. `half_width` of the pool in m: 0.016 makes more than 2000 particles, enough for a second thread.
  virtual std::string sceneText() const { return poolScene(0.008); }
  static std::string poolScene(double half_width) {
    return fmt::format(
        "name: 'pool'\n"
        "domain {{ lower_m {{ x: -0.04 y: -0.04 z: -0.012 }} upper_m {{ x: 0.04 y: 0.04 z: 0.04 }} capacity: 6000 }}\n"
        "resolution {{ spacing_m: 0.002 }}\n"
        "compressibility {{ design_speed_m_per_s: 0.5 max_fall_or_depth_m: 0.01 }}\n"
        "effects {{ gravity {{ acceleration_m_per_s2 {{ z: -9.81 }} }} pressure {{}} viscosity {{}} applied_force {{}} }}\n"
        "tissue {{ plane {{ normal {{ z: 1.0 }} }} }}\n"
        "fluid_blocks {{ lower_m {{ x: -{0} y: -{0} z: 0 }} upper_m {{ x: {0} y: {0} z: 0.018 }} jitter: 0.2 }}\n"
        "wounds {{ name: 'cut' disc {{ radius_m: 0.004 }} flow_ml_per_s: 3 }}\n"
        "output {{ frame_rate_hz: 500 }}\n",
        half_width);
  }

  std::string sceneFile() const { return (folder_ / "pool.textproto").string(); }
  std::string checkpointDir() const { return (folder_ / "checkpoints").string(); }

  std::unique_ptr<client_test::RunningDaemon> start(const std::vector<std::string>& more) const {
    return client_test::RunningDaemon::start(BLEEDD_PATH, sceneFile(), session_, kDomain, more);
  }

  std::filesystem::path folder_;
  std::string session_;
};

}  // namespace bleedsim::replay_test
