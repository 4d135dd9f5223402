// The shipped configurations of Cyclone DDS, loaded by both ends as a user loads them.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <unistd.h>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::HasSubstr;

class DdsConfigTest : public ServiceTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    ServiceTest::SetUp();
    std::ifstream shipped{std::string{BLEEDSIM_DDS_CONFIGS} + "/" + GetParam()};
    std::string xml{std::istreambuf_iterator<char>{shipped}, {}};
    // Every host has this one, and nothing leaves it.
    const std::size_t at = xml.find("eth0\"/>");
    if (at != std::string::npos) xml.replace(at, 4, "lo");
    file_ = std::filesystem::temp_directory_path() / fmt::format("bleedsim-dds-{}.xml", getpid());
    std::ofstream{file_} << xml;
    // Parts of a configuration follow each other: the tag keeps tests apart that run side by side.
    const std::string tag =
        fmt::format("<CycloneDDS><Domain Id=\"any\"><Discovery><Tag>dds-{}</Tag></Discovery></Domain></CycloneDDS>", getpid());
    setenv("CYCLONEDDS_URI", fmt::format("file://{},{}", file_.string(), tag).c_str(), 1);
  }
  void TearDown() override {
    unsetenv("CYCLONEDDS_URI");
    std::filesystem::remove(file_);
    ServiceTest::TearDown();
  }

  std::filesystem::path file_;
};

TEST_P(DdsConfigTest, CarriesASession) {
  test::ChildProcess daemon{daemonCommand("shipped", {"--interface", "nosuch9"})};
  Probe probe{domain(), "shipped"};
  probe.frame([](const FrameHead& frame) { return frame.count > 0; });
  EXPECT_EQ(probe.ask(bleed_v1_REQUEST_PING).code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_THAT(daemon.output(), HasSubstr("DDS uses what CYCLONEDDS_URI says (file://" + file_.string()));
  EXPECT_THAT(daemon.output(), HasSubstr("--interface nosuch9 is not used"));
}

INSTANTIATE_TEST_SUITE_P(Files, DdsConfigTest, testing::Values("loopback.xml", "network.xml"));

}  // namespace
}  // namespace bleedsim::service_test
