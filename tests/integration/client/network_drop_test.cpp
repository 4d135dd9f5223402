// A trainer on another host whose network drops: the daemon runs in a network namespace of its own, at the other end of a cable
// that the test pulls out. It needs the right to make one, and is skipped without.
#include <condition_variable>
#include <csignal>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <mutex>
#include <unistd.h>

#include "tests/integration/client/running_daemon.h"

namespace bleedsim::client_test {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kDomain = 71;

bool ip(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"/usr/sbin/ip"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return test::runProcess(command).code == 0;
}

/// Two hosts and a cable: this process at `here`, the namespace at `there`.
class Cable {
 public:
  Cable()
      : space_{fmt::format("bleedsim{}", getpid())},
        here{fmt::format("bsa{}", getpid() % 100000)},
        there{fmt::format("bsb{}", getpid() % 100000)} {
    const std::string net = fmt::format("10.213.{}", getpid() % 250);
    laid_ = access("/usr/sbin/ip", X_OK) == 0 && ip({"netns", "add", space_}) &&
            ip({"link", "add", here, "type", "veth", "peer", "name", there, "netns", space_}) &&
            ip({"address", "add", net + ".1/24", "dev", here}) && ip({"link", "set", here, "up"}) &&
            ip({"-n", space_, "address", "add", net + ".2/24", "dev", there}) && ip({"-n", space_, "link", "set", there, "up"}) &&
            ip({"-n", space_, "link", "set", "lo", "up"});
  }
  ~Cable() {
    if (access("/usr/sbin/ip", X_OK) != 0) return;
    ip({"link", "delete", here});
    ip({"netns", "delete", space_});
  }
  Cable(const Cable&) = delete;
  Cable& operator=(const Cable&) = delete;

  bool laid() const { return laid_; }
  bool pullOut() { return ip({"link", "set", here, "down"}); }
  bool plugIn() { return ip({"link", "set", here, "up"}); }
  std::vector<std::string> atTheOtherEnd(const std::vector<std::string>& command) const {
    std::vector<std::string> out{"/usr/sbin/ip", "netns", "exec", space_};
    out.insert(out.end(), command.begin(), command.end());
    return out;
  }

 private:
  std::string space_;
  bool laid_ = false;

 public:
  const std::string here;
  const std::string there;
};

TEST(NetworkDrop, ATrainerComesBackByItself) {
  isolate();
  Cable cable;
  if (!cable.laid()) GTEST_SKIP() << "needs iproute2 and the right to make network namespaces (root)";
  test::ChildProcess daemon{cable.atTheOtherEnd({BLEEDD_PATH, "--scene", SCENE_DIR "/round_wound.textproto", "--session", "far",
                                                 "--domain", std::to_string(kDomain), "--interface", cable.there})};
  auto client = client::Client::create({.domain = kDomain, .interface = cable.here});
  ASSERT_TRUE(client.ok()) << client.status().message();

  std::mutex mutex;
  std::condition_variable changed;
  client::ConnectionState connection;
  std::vector<client::FrameStats> stats;
  const auto wait = [&](const auto& condition) {
    std::unique_lock lock{mutex};
    return changed.wait_for(lock, test::kPatience, condition);
  };
  client::SessionOptions options{.delivery = client::Delivery::queue};
  options.on_connection = [&](const client::ConnectionState& state) {
    const std::lock_guard lock{mutex};
    connection = state;
    changed.notify_all();
  };
  options.on_stats = [&](const client::FrameStats& figures) {
    const std::lock_guard lock{mutex};
    stats.assign(1, figures);
    changed.notify_all();
  };
  auto session = client->open("far", options, test::kPatience);
  ASSERT_TRUE(session.ok()) << session.status().message() << daemon.output();
  ASSERT_TRUE(session->ping(test::kPatience).ok());
  ASSERT_TRUE(session->waitFrame(test::kPatience).ok());
  auto tool = session->instrument(1, "PSM1");
  ASSERT_TRUE(tool.ok()) << tool.status().message();

  ASSERT_TRUE(tool->send({.position = {0.0, 0.0, 0.005}, .tip_radius_m = 0.01}).ok());
  const std::uint64_t number_before = tool->lastSeq();

  ASSERT_TRUE(cable.pullOut());
  const client::Reply unanswered = session->resume().get();
  EXPECT_EQ(unanswered.code, client::ReplyCode::no_answer) << unanswered.reason;
  ASSERT_TRUE(wait([&] { return !connection.connected; }));
  // Until the lease of the participant has run out as well, on both ends: nothing of the old match is left.
  while (!client->sessions().empty()) client->listSessions(100ms);
  EXPECT_FALSE(session->waitAlive(13s)) << "some 15 s without the network";
  while (session->tryTakeFrame() != nullptr) {}
  const std::uint64_t received = session->frameCounters().received;

  ASSERT_TRUE(cable.plugIn());
  ASSERT_TRUE(wait([&] { return connection.connected; }));
  EXPECT_EQ(connection.losses, 1U);
  EXPECT_EQ(connection.replacements, 0U) << "the same daemon";
  const auto frame = session->waitFrame(test::kPatience);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_GT(session->frameCounters().received, received);
  EXPECT_GT(session->frameCounters().gaps, 0U) << "frames went on meanwhile";
  EXPECT_TRUE(session->pace({client::PaceMode::real_time, 1.0}).get().accepted());
  ASSERT_TRUE(session->ping(test::kPatience).ok());
  EXPECT_GE(session->clockOffset()->samples, 2U) << "of before and after";
  const auto used = [&] {
    return !stats.empty() &&
           std::any_of(stats[0].instruments.begin(), stats[0].instruments.end(),
                       [&](const client::AppliedInstrument& applied) { return applied.client == session->clientId(); });
  };
  for (int i = 0; i < 100'000; ++i) {
    static_cast<void>(tool->send({.position = {0.0, 0.0, 0.005}, .tip_radius_m = 0.01, .force = {0.0, 0.0, 1e-4}}).ok());
    std::unique_lock lock{mutex};
    if (changed.wait_for(lock, 20ms, used)) break;
  }
  EXPECT_TRUE(wait(used)) << "the tool reaches it again";
  EXPECT_GT(tool->lastSeq(), number_before) << "its numbers go on";
  EXPECT_TRUE(session->shutdown().get().accepted());
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

}  // namespace
}  // namespace bleedsim::client_test
