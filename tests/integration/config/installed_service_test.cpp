// What "cmake --install" with the component "daemon" lays down: the unit, the kernel setting, scenes and configurations.
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <optional>
#include <sstream>

#include "service/transport/receive_buffer.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::config_test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::IsEmpty;

class InstalledServiceTest : public testing::Test {
 protected:
  void SetUp() override {
    const test::Finished installed =
        test::runProcess({CMAKE_PATH, "--install", BLEEDSIM_BUILD_DIR, "--prefix", root_.string(), "--component", "daemon"});
    ASSERT_EQ(installed.code, 0) << installed.output;
  }

  std::string unit() const { return (root_ / "lib/systemd/system/bleedd@.service").string(); }
  static std::vector<std::string> linesOf(const fs::path& file) {
    std::ifstream stream{file};
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }
  /// What the unit sets a key to; empty: it does not.
  std::string setting(const std::string& key) const {
    for (const std::string& line : linesOf(unit())) {
      if (line.starts_with(key + "=")) return line.substr(key.size() + 1);
    }
    return {};
  }
  /// systemd-analyze with these arguments; nothing where it is not installed.
  static std::optional<test::Finished> analyze(std::vector<std::string> arguments) {
    if (test::runProcess({"/usr/bin/env", "sh", "-c", "command -v systemd-analyze"}).code != 0) return {};
    arguments.insert(arguments.begin(), {"/usr/bin/env", "systemd-analyze"});
    return test::runProcess(arguments);
  }

  const test::TemporaryFolder temporary_;
  const fs::path& root_ = temporary_.path();
};

// It ends with 0 whatever it finds, but it says what.
TEST_F(InstalledServiceTest, SystemdFindsNothingWrongWithTheUnit) {
  const std::optional<test::Finished> verified = analyze({"verify", unit()});
  if (!verified) GTEST_SKIP() << "systemd-analyze is not installed";
  EXPECT_EQ(verified->code, 0);
  EXPECT_THAT(verified->output, IsEmpty());
}

// 0 is a service that can do nothing, 10 one without any protection; a daemon on the network needs sockets.
TEST_F(InstalledServiceTest, TheUnitGivesAwayLittle) {
  const std::optional<test::Finished> rated = analyze({"security", "--offline=true", "--no-pager", "--threshold=15", unit()});
  if (!rated) GTEST_SKIP() << "systemd-analyze is not installed";
  EXPECT_EQ(rated->code, 0) << rated->output;
}

TEST_F(InstalledServiceTest, TheUnitStartsTheInstalledProgramOnAnInstalledScene) {
  std::string start = setting("ExecStart");
  const auto put = [&start](const std::string& name, const std::string& value) {
    const std::size_t at = start.find(name);
    ASSERT_NE(at, std::string::npos) << name << " in " << start;
    start.replace(at, name.size(), value);
  };
  const std::string scene = setting("Environment");
  ASSERT_TRUE(scene.starts_with("BLEEDD_SCENE=")) << scene;
  put("%i", "theatre");
  put("${BLEEDD_SCENE}", scene.substr(scene.find('=') + 1));
  put("$BLEEDD_OPTIONS", "--check");
  EXPECT_TRUE(start.starts_with(root_.string() + "/bin/bleedd ")) << start;
  std::istringstream words{start};
  const std::vector<std::string> command{std::istream_iterator<std::string>{words}, {}};
  const test::Finished checked = test::runProcess(command);
  EXPECT_EQ(checked.code, 0) << checked.output;
}

TEST_F(InstalledServiceTest, TheUnitIsOneSessionThatSystemdWatches) {
  EXPECT_EQ(setting("Type"), "notify");
  EXPECT_EQ(setting("WatchdogSec"), "30");
  EXPECT_EQ(setting("EnvironmentFile"), "-/etc/bleedsim/%i.conf");
  EXPECT_EQ(setting("Restart"), "on-failure");
}

// A wrong scene is tried once, not again and again.
TEST_F(InstalledServiceTest, TheUnitGivesUpWhereBleeddSaysThatTryingAgainDoesNotHelp) {
  std::istringstream codes{setting("RestartPreventExitStatus")};
  const std::vector<int> given_up{std::istream_iterator<int>{codes}, {}};
  EXPECT_THAT(given_up, testing::ElementsAre(2, 3));
  const fs::path bleedd = root_ / "bin/bleedd";
  EXPECT_THAT(given_up, Contains(test::runProcess({bleedd.string(), "--scene", (root_ / "no.textproto").string()}).code));
}

TEST_F(InstalledServiceTest, TheKernelSettingIsWhatBleedsimAsksFor) {
  EXPECT_THAT(linesOf(root_ / "lib/sysctl.d/60-bleedsim.conf"),
              Contains(fmt::format("net.core.rmem_max = {}", transport::kReceiveBufferBytes)));
}

TEST_F(InstalledServiceTest, ConfigurationsAndTheExampleAreThere) {
  for (const char* file : {"dds/loopback.xml", "dds/network.xml", "session.conf.example", "scenes/incision.textproto"}) {
    EXPECT_TRUE(fs::is_regular_file(root_ / "share/bleedsim" / file)) << file;
  }
  EXPECT_TRUE(fs::is_regular_file(root_ / "bin/bleedctl"));
}

}  // namespace
}  // namespace bleedsim::config_test
