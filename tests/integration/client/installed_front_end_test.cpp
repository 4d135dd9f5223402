// What somebody who writes a front end does: install, build the example against the installed package, run it.
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/integration/client/running_daemon.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::client_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class InstalledFrontEndTest : public testing::Test {
 protected:
  void SetUp() override {
    isolate();
    for (const char* component : {"client", "daemon"}) {
      const test::Finished installed =
          test::runProcess({CMAKE_PATH, "--install", BLEEDSIM_BUILD_DIR, "--prefix", prefix(), "--component", component}, true);
      ASSERT_EQ(installed.code, 0) << installed.output;
    }
  }

  std::string prefix() const { return (root_ / "prefix").string(); }
  std::string build() const { return (root_ / "front_end").string(); }

  const test::TemporaryFolder temporary_;
  const fs::path& root_ = temporary_.path();
};

std::string textOf(const fs::path& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

TEST_F(InstalledFrontEndTest, TheExampleBuildsAgainstTheInstalledPackageAndTrainsInARunningSession) {
  const test::Finished configured = test::runProcess(
      {CMAKE_PATH, "-S", FRONT_END_SOURCE_DIR, "-B", build(), "-G", CMAKE_GENERATOR_NAME, "-DCMAKE_BUILD_TYPE=Release",
       "-DCMAKE_PREFIX_PATH=" + prefix(), "-DCMAKE_CXX_COMPILER=" CMAKE_CXX_COMPILER_PATH,
       "-DCMAKE_CXX_FLAGS=" FRONT_END_CXX_FLAGS, "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF"},
      true);
  ASSERT_EQ(configured.code, 0) << configured.output;
  const test::Finished built = test::runProcess({CMAKE_PATH, "--build", build()}, true);
  ASSERT_EQ(built.code, 0) << built.output;

  const auto daemon =
      RunningDaemon::start(prefix() + "/bin/bleedd", prefix() + "/share/bleedsim/scenes/round_wound.textproto", "training", 67);
  ASSERT_NE(daemon, nullptr);
  const test::Finished front_end = test::runProcess({build() + "/front_end", "training", "67"}, true);
  EXPECT_EQ(front_end.code, 0) << front_end.output;
  EXPECT_THAT(front_end.output, testing::AllOf(HasSubstr("round trip"), HasSubstr(" particles, highest "),
                                               testing::ContainsRegex("done: [0-9]+ frames, [0-9]+ gaps")));
  // 60 frames of 1/60 s at 1 mL/s.
  const std::string label = "trainer's wound bled ";
  const std::size_t bled = front_end.output.find(label);
  ASSERT_NE(bled, std::string::npos) << front_end.output;
  EXPECT_GT(std::strtod(front_end.output.c_str() + bled + label.size(), nullptr), 0.8) << front_end.output;
  // It ends the session, so the daemon ends in order.
  EXPECT_EQ(daemon->process().wait(), 0) << daemon->process().output();
}

TEST_F(InstalledFrontEndTest, ThePackageNamesNoFolderOfTheBuild) {
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator{prefix()}) {
    if (entry.path().extension() != ".cmake") continue;
    ++files;
    const std::string text = textOf(entry.path());
    EXPECT_THAT(text, testing::Not(HasSubstr(BLEEDSIM_SOURCE_DIR "/"))) << entry.path();
    EXPECT_THAT(text, testing::Not(HasSubstr(BLEEDSIM_BUILD_DIR "/"))) << entry.path();
  }
  EXPECT_GE(files, 4U);
}

}  // namespace
}  // namespace bleedsim::client_test
