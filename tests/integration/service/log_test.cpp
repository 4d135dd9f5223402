// bleedd's log file, and the tool that rotates it.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <unistd.h>

#include "tests/integration/service/notify_socket.h"
#include "tests/integration/service/probe.h"
#include "tests/support/temporary_folder.h"

namespace bleedsim::service_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class DaemonLogTest : public ServiceTest {
 protected:
  std::string file(const char* name = "bleedd.log") const { return (folder_ / name).string(); }
  static std::string textOf(const std::string& path) {
    std::ifstream stream{path};
    return {std::istreambuf_iterator<char>{stream}, {}};
  }

  const test::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

TEST_F(DaemonLogTest, IsReopenedOnSighup) {
  test::ChildProcess daemon{daemonCommand("rotated", {"--log-file", file()})};
  Probe probe{domain(), "rotated"};
  probe.frame();
  EXPECT_THAT(textOf(file()), AllOf(HasSubstr("runs session 'rotated'"), HasSubstr("DDS uses loopback only")));
  fs::rename(file(), file("bleedd.log.1"));
  daemon.signal(SIGHUP);
  // Signals are taken one after the other, and the file is opened anew before the end is logged.
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_THAT(textOf(file()), AllOf(HasSubstr("log file reopened"), HasSubstr("ended"), Not(HasSubstr("runs session"))));
  EXPECT_THAT(textOf(file("bleedd.log.1")), AllOf(HasSubstr("runs session"), Not(HasSubstr("ended"))));
  EXPECT_THAT(daemon.output(), Not(HasSubstr("runs session"))) << "standard error is for what needs attention";
}

TEST_F(DaemonLogTest, OfAFileThatCannotBeOpenedBleeddTellsAndEnds) {
  test::ChildProcess daemon{daemonCommand("nowhere", {"--log-file", file("missing/bleedd.log")})};
  EXPECT_EQ(daemon.wait(), 2);
  EXPECT_THAT(daemon.output(), AllOf(HasSubstr("missing/bleedd.log"), HasSubstr("No such file")));
}

TEST_F(DaemonLogTest, ALevelQuietsIt) {
  test::ChildProcess daemon{daemonCommand("quiet", {"--log-level", "error", "--pace", "max", "--duration", "0.05"})};
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_THAT(daemon.output(), Not(HasSubstr("runs session")));
}

TEST_F(DaemonLogTest, SighupWithoutAFileIsAnEndAsOfAClosedTerminal) {
  unsetenv("NOTIFY_SOCKET");
  test::ChildProcess daemon{daemonCommand("terminal")};
  Probe probe{domain(), "terminal"};
  probe.frame();
  daemon.signal(SIGHUP);
  EXPECT_EQ(daemon.wait(), 0);
  probe.status([](const StatusHead& status) { return status.state == bleed_v1_STATE_STOPPED; });
}

TEST_F(DaemonLogTest, SighupUnderAServiceManagerIsAReload) {
  NotifySocket manager{std::chrono::seconds{1}};
  test::ChildProcess daemon{daemonCommand("reloaded")};
  ASSERT_TRUE(manager.waitFor("READY=1"));
  daemon.signal(SIGHUP);
  ASSERT_TRUE(daemon.waitForOutput("no log file to reopen"));
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0);
}

}  // namespace
}  // namespace bleedsim::service_test
