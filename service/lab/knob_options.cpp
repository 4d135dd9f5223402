#include "service/lab/knob_options.h"

#include <CLI/CLI.hpp>

#include "service/status/number_text.h"

namespace bleedsim::lab {

void addKnobOptions(CLI::App& command, KnobArguments& arguments) {
  command.add_option("--preset", arguments.preset, "standard: h = 2.5 dx, 20 particles across; fine: h = 3 dx, 40 across")
      ->capture_default_str()
      ->check(CLI::IsMember({"standard", "fine"}));
  command.add_option("--across", arguments.across, "Particles across the case: its spacing")->check(CLI::Range(8, 160));
  command.add_option("--support", arguments.support_ratio, "Support radius in spacings, h/dx")->check(finiteIn(1.5, 3.5));
  command.add_option("--mach", arguments.mach_factor, "Speed of sound over that of the flow; default 10")
      ->check(finiteIn(5.0, 50.0));
  command.add_option("--cfl", arguments.cfl, "Time step; 0.4, the default, is the stable one")->check(finiteIn(0.01, kStableCfl));
  command.add_option("--precision", arguments.precision, "float, or double: the scalar reference, several times slower")
      ->capture_default_str()
      ->check(CLI::IsMember({"float", "double"}));
  command.add_option("--threads", arguments.threads, "Threads; figures do not depend on their number")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command.add_option("--simd", arguments.simd, "auto, scalar, avx2 or avx512")->capture_default_str();
}

Result<Knobs> knobsOf(const KnobArguments& arguments) {
  const auto target = sph::parseSimdTarget(arguments.simd);
  if (!target) return target.status();
  Knobs knobs = knobsOf(arguments.preset == "fine" ? Preset::fine : Preset::standard);
  knobs.across = arguments.across.value_or(knobs.across);
  knobs.support_ratio = arguments.support_ratio.value_or(knobs.support_ratio);
  knobs.mach_factor = arguments.mach_factor.value_or(knobs.mach_factor);
  knobs.cfl = arguments.cfl.value_or(knobs.cfl);
  knobs.threads = arguments.threads;
  knobs.simd = *target;
  if (arguments.precision == "double") {
    knobs.precision = sph::Precision::float64;
    if (knobs.simd != sph::SimdTarget::automatic && knobs.simd != sph::SimdTarget::scalar)
      return Status{StatusCode::invalid_argument, "double precision runs on the scalar target only: leave --simd out"};
  }
  return knobs;
}

}  // namespace bleedsim::lab
