// bleedd under a service manager, played by the test: systemd itself runs in few places where tests do.
#include <algorithm>
#include <csignal>
#include <gmock/gmock.h>

#include "tests/integration/service/notify_socket.h"
#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const std::string kReady = "READY=1";
const std::string kFed = "WATCHDOG=1";
const std::string kStopping = "STOPPING=1";

class ServiceManagerTest : public ServiceTest {
 protected:
  std::optional<std::string> stateWith(const std::string& start) {
    return manager_.waitFor([&](const std::string& line) { return line.starts_with("STATUS=" + start); });
  }

  NotifySocket manager_{std::chrono::seconds{1}};
};

TEST_F(ServiceManagerTest, HearsOfItsStartItsLifeAndItsEnd) {
  test::ChildProcess daemon{daemonCommand("managed")};
  ASSERT_TRUE(manager_.waitFor(kReady)) << daemon.output();
  EXPECT_THAT(manager_.heard(), Not(Contains(kStopping)));
  Probe probe{domain(), "managed"};
  EXPECT_EQ(probe.status().state, static_cast<std::uint32_t>(bleed_v1_STATE_RUNNING));

  for (int i = 0; i < 3; ++i) ASSERT_TRUE(manager_.waitFor(kFed)) << "while it runs";
  ASSERT_EQ(probe.ask(bleed_v1_REQUEST_PAUSE).code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED));
  const std::optional<std::string> paused = stateWith("paused");
  ASSERT_TRUE(paused);
  EXPECT_THAT(*paused, AllOf(HasSubstr("real-time factor "), HasSubstr(" s simulated"), HasSubstr(" particles")));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(manager_.waitFor(kFed)) << "in a pause";

  daemon.signal(SIGTERM);
  ASSERT_TRUE(manager_.waitFor(kStopping));
  EXPECT_EQ(daemon.wait(), 0);
  EXPECT_EQ(std::count(manager_.heard().begin(), manager_.heard().end(), kReady), 1);
}

TEST_F(ServiceManagerTest, HearsOfNoReadySessionWhenTheNameIsTaken) {
  test::ChildProcess first{daemonCommand("taken")};
  ASSERT_TRUE(manager_.waitFor(kReady));
  const std::size_t before = manager_.heard().size();
  test::ChildProcess second{daemonCommand("taken")};
  EXPECT_EQ(second.wait(), 3);
  first.signal(SIGTERM);
  // A daemon that hears of the other only after its own start was ready for a moment, and says that it stops.
  const auto heard = [&](const std::string& line) {
    return std::count(manager_.heard().begin() + static_cast<std::ptrdiff_t>(before), manager_.heard().end(), line);
  };
  do { ASSERT_TRUE(manager_.waitFor(kStopping)) << "more were ready than stopped"; } while (heard(kStopping) <= heard(kReady));
}

}  // namespace
}  // namespace bleedsim::service_test
