// Hard cases 14 and 19: wounds whose pressure jumps, and a world that is full.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/lab/hardcases/case_scene.h"
#include "service/lab/hardcases/cases.h"
#include "service/status/units.h"

namespace bleedsim::lab {

// Orifice law Q = Cd A sqrt(2 dp/rho); between 0 and 120 mmHg every 20 steps.
void pressureSteps(CaseRun& run) {
  constexpr double kRadius = 0.001;  // m
  const double high = pascalsFromMmHg(120.0);
  sph::WorldDescription scene = woundScene(kRadius, 0.0);
  scene.wounds.front().drive = sph::PressureDriveSettings{.inlet_pressure = high};
  scene.domain.upper.z() = 0.03;
  const auto trial = run.start(scene);
  if (!trial) return;
  double integral = 0.0;
  for (int step = 0; step < 2500; ++step) {
    if (step % 20 == 0) {
      sph::UpdateWound change;
      change.wound_id = 1;
      change.drive = sph::PressureDriveSettings{.inlet_pressure = step % 40 == 0 ? 0.0 : high};
      if (!trial->apply(change)) return;
    }
    const double flow = trial->world().wounds().front().flow;
    if (!trial->step()) return;
    integral += flow * trial->stats().dt;
  }
  const sph::WorldStats stats = trial->stats();
  const double particle = scene.particleVolume();
  const double full = 0.61 * std::numbers::pi * kRadius * kRadius * std::sqrt(2.0 * high / scene.rest_density) * stats.time;
  run.within("volume over that of the whole pressure", stats.emitted_volume / full, 0.3, 0.7);
  run.atMost("volume less integral of Q, particles", std::abs(stats.emitted_volume - integral) / particle, 1.0);
  run.atMost("volume less the ledger's, particles", std::abs(stats.emitted_volume - stats.commanded_volume) / particle, 1.0);
}

void fullToCapacity(CaseRun& run) {
  sph::WorldDescription scene = woundScene(0.002, 3e-6);
  scene.capacity = 200;
  const auto trial = run.start(scene);
  if (!trial) return;
  std::uint32_t most = 0;
  if (!trial->runFor(0.08, [&] { most = std::max(most, trial->world().particleCount()); })) return;
  const sph::WorldStats stats = trial->stats();
  const auto refused = static_cast<double>(trial->counted(sph::Counter::emission_refused));
  const double particle = scene.particleVolume();
  run.within("most particles", most, 100.0, 200.0);
  run.atLeast("emissions refused and counted", refused, 25.0);
  run.atMost("volume and refused less the ledger's, particles",
             std::abs((stats.emitted_volume - stats.commanded_volume) / particle + refused), 1.0);
  sph::UpdateWound stop;
  stop.wound_id = 1;
  stop.drive = sph::FlowDrive{0.0};
  if (!trial->apply(stop) || !trial->runFor(0.02)) return;
  run.within("injected after the flow stopped", static_cast<double>(trial->stats().injected - stats.injected), 0.0, 0.0);
}

}  // namespace bleedsim::lab
