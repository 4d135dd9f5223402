// Frames and status: who gets what, and that nobody holds the others up.
#include <csignal>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

TEST_F(ServiceTest, ALateJoinerGetsSceneAndStatusAtOnce) {
  test::ChildProcess daemon{daemonCommand("late")};
  {
    Probe early{domain(), "late"};
    early.frame([](const FrameHead& frame) { return frame.seq > 20; });
    early.ask(bleed_v1_REQUEST_PAUSE);
  }
  // The session stands still: what comes now was kept for late joiners.
  Probe late{domain(), "late"};
  EXPECT_EQ(late.sceneName(), "small");
  const StatusHead status = late.status();
  EXPECT_EQ(status.name, "late");
  EXPECT_EQ(status.pid, daemon.pid());
}

// Frames that a busy machine made the daemon overwrite before they were published have no number.
TEST_F(ServiceTest, AReliableSubscriberGetsEveryFrame) {
  Probe probe{domain(), "every"};
  test::ChildProcess daemon{daemonCommand("every", {"--frame-rate", "100"})};
  const FrameHead first = probe.frame();
  std::uint64_t expected = first.seq;
  std::uint64_t step = first.step;
  for (int i = 0; i < 200; ++i) {
    const FrameHead frame = probe.frame();
    ASSERT_EQ(frame.seq, ++expected);
    ASSERT_GT(frame.step, step);
    ASSERT_EQ(frame.payload, std::size_t{frame.count} * 16);
    step = frame.step;
  }
  const StatsHead stats = probe.stats([&](const StatsHead& head) { return head.seq == expected; });
  EXPECT_EQ(stats.step, step) << "frame and statistics of one number belong to one state";
}

TEST_F(ServiceTest, AReaderThatIsTooSlowSeesGapsInTheNumbers) {
  Probe slow{domain(), "slow", Reading::live};
  test::ChildProcess daemon{daemonCommand("slow", {"--frame-rate", "100"})};
  std::uint64_t last = slow.frame().seq;
  std::uint64_t received = 1;
  std::uint64_t gaps = 0;
  const std::uint64_t first = last;
  for (int i = 0; i < 5; ++i) {
    slow.stats([&](const StatsHead& head) { return head.seq >= last + 20; });
    const FrameHead frame = slow.frame([&](const FrameHead& head) { return head.seq > last; });
    gaps += frame.seq - last - 1;
    last = frame.seq;
    ++received;
  }
  EXPECT_GT(gaps, 0U);
  EXPECT_EQ(received + gaps, last - first + 1);
}

TEST_F(ServiceTest, TwoSessionsOfOneDomainDoNotMix) {
  test::ChildProcess daemon_a{daemonCommand("a")};
  test::ChildProcess daemon_b{daemonCommand("b")};
  Probe a{domain(), "a"};
  Probe b{domain(), "b"};
  const StatusHead status_a = a.status();
  const StatusHead status_b = b.status();
  EXPECT_EQ(status_a.pid, daemon_a.pid());
  EXPECT_EQ(status_b.pid, daemon_b.pid());
  EXPECT_NE(status_a.session, status_b.session);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(a.frame().session, status_a.session);
    EXPECT_EQ(b.frame().session, status_b.session);
  }
  a.ask(bleed_v1_REQUEST_PAUSE);
  const std::uint64_t step = b.frame().step;
  b.frame([&](const FrameHead& frame) { return frame.step > step + 200; });
  b.status([](const StatusHead& status) { return status.state == bleed_v1_STATE_RUNNING; });
}

TEST_F(ServiceTest, AStoppedOrKilledSubscriberHoldsNobodyUp) {
  test::ChildProcess daemon{daemonCommand("held")};
  test::ChildProcess stopped{{BLEEDSIM_SUBSCRIBER, std::to_string(domain()), "held"}};
  test::ChildProcess killed{{BLEEDSIM_SUBSCRIBER, std::to_string(domain()), "held"}};
  ASSERT_TRUE(stopped.waitForOutput("reading"));
  ASSERT_TRUE(killed.waitForOutput("reading"));
  Probe healthy{domain(), "held"};
  std::uint64_t expected = healthy.frame().seq;
  stopped.signal(SIGSTOP);
  killed.signal(SIGKILL);
  const std::uint64_t step = healthy.frame().step;
  ++expected;
  for (int i = 0; i < 240; ++i) ASSERT_EQ(healthy.frame().seq, ++expected);
  EXPECT_GT(healthy.frame().step, step + 1000);
  EXPECT_EQ(healthy.status([&](const StatusHead& status) { return status.step > step + 1000; }).counter("write_failures"), 0U);
}

}  // namespace
}  // namespace bleedsim::service_test
