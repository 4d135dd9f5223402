// What a flood of the largest requests takes of the daemon's memory. Not with sanitizers, which keep what was freed.
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

constexpr std::uint32_t kAccepted = bleed_v1_REPLY_ACCEPTED;

/// MiB that a process has, or had at most, resident: `field` of /proc/PID/status.
double residentMiB(pid_t pid, const std::string& field) {
  std::ifstream status{fmt::format("/proc/{}/status", pid)};
  for (std::string word; status >> word;) {
    double kib = 0.0;
    if (word == field + ":" && status >> kib) return kib / 1024.0;
  }
  ADD_FAILURE() << "no " << field << " of process " << pid;
  return 0.0;
}

TEST_F(ServiceTest, AFloodOfScenesTakesNoMemory) {
  test::ChildProcess daemon{daemonCommand("scenes")};
  Probe polite{domain(), "scenes"};
  Probe flooder{domain(), "scenes"};
  ASSERT_EQ(flooder.ask(Probe::pace(1.0)).code, kAccepted);
  const double before = residentMiB(daemon.pid(), "VmRSS");
  std::string text = "# " + std::string(1'000'000, 'x');
  const auto load = Probe::body(bleed_v1_REQUEST_LOAD_SCENE, [&text](auto& body) { body._u.load_scene.text = text.data(); });
  std::uint64_t sent = 0;
  while (sent < 300) {
    sent += flooder.send(load) ? 1 : 0;
    if (sent % 50 == 0) { ASSERT_EQ(polite.ask(bleed_v1_REQUEST_PING).code, kAccepted); }
  }
  polite.status([&](const StatusHead& head) { return head.activityOf(flooder.client()).requests >= 200; });
  // 300 MB came; a few texts wait, are read or stand in the middleware's buffers.
  EXPECT_LT(residentMiB(daemon.pid(), "VmHWM") - before, 100.0);
  const bleed_v1_Reply reply = polite.ask(bleed_v1_REQUEST_RESUME);
  EXPECT_TRUE(reply.code == kAccepted || reply.code == bleed_v1_REPLY_STATE) << reply.reason;
}

}  // namespace
}  // namespace bleedsim::service_test
