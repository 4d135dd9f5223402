// A dead or silent front end never pushes for ever.
#include <fstream>

#include "tests/integration/service/probe.h"

namespace bleedsim::service_test {
namespace {

bool ended(const bleed_v1_Journal& entry) { return entry.body._d == bleed_v1_JOURNAL_INSTRUMENT_END; }

/// Streams until a step has used a sample.
void pushUntilApplied(Probe& probe) {
  std::uint64_t seq = 0;
  probe.stats([&](const StatsHead& stats) {
    probe.sendInstrument(++seq);
    return stats.instruments == 1;
  });
}

TEST_F(ServiceTest, ASilentInstrumentsForceEnds) {
  test::ChildProcess daemon{daemonCommand("silent")};
  Probe probe{domain(), "silent"};
  probe.frame([](const FrameHead& frame) { return frame.count > 5; });
  pushUntilApplied(probe);
  probe.stats([](const StatsHead& stats) { return stats.instruments == 0; });
  EXPECT_EQ(probe.journal(ended).body._u.instrument_end.reason, static_cast<std::uint32_t>(bleed_v1_INSTRUMENT_END_EXPIRED));
}

TEST_F(ServiceTest, TheForceOfAnInstrumentEndsWithItsWriter) {
  std::ofstream{sceneFile()} << smallScene(10.0);  // far longer than it takes to notice
  test::ChildProcess daemon{daemonCommand("gone")};
  Probe probe{domain(), "gone"};
  probe.frame([](const FrameHead& frame) { return frame.count > 5; });
  pushUntilApplied(probe);
  probe.dropInstrumentWriter();
  EXPECT_EQ(probe.journal(ended).body._u.instrument_end.reason, static_cast<std::uint32_t>(bleed_v1_INSTRUMENT_END_LOST));
  probe.stats([](const StatsHead& stats) { return stats.instruments == 0; });
}

}  // namespace
}  // namespace bleedsim::service_test
