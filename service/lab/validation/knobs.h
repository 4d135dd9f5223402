// What a validation case can be run with: the knobs of physics.md section 7.
#pragma once

#include <cstdint>

#include "service/sph/world.h"

namespace bleedsim::lab {

/// standard: h = 2.5 dx, 20 particles across; fine: h = 3 dx, 40 across (physics.md section 5).
enum class Preset { standard, fine };

inline constexpr double kStableCfl = 0.4;  ///< of the solver's acoustic limit (time_step.h)

struct Knobs {
  Preset preset = Preset::standard;  ///< whose thresholds are compared with
  int across = 20;                   ///< particles across the case: its spacing
  double support_ratio = 2.5;        ///< h/dx
  double mach_factor = 10.0;
  /// The first step of the case is this over kStableCfl times the stable one, and no later step is longer. kStableCfl: as the
  /// solver chooses.
  double cfl = kStableCfl;
  sph::Precision precision = sph::Precision::float32;
  int threads = 1;
  sph::SimdTarget simd = sph::SimdTarget::automatic;
  std::uint64_t seed = 1;  ///< of the jitter of cases that start disordered
  bool beside = true;      ///< also what is reported only, such as the literal model

  double bound(double standard, double fine) const { return preset == Preset::fine ? fine : standard; }
  sph::WorldOptions options() const { return {.threads = threads, .simd = simd, .precision = precision}; }
};

inline Knobs knobsOf(Preset preset) {
  Knobs knobs;
  knobs.preset = preset;
  if (preset == Preset::fine) {
    knobs.across = 40;
    knobs.support_ratio = 3.0;
  }
  return knobs;
}

}  // namespace bleedsim::lab
