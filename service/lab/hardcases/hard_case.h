// The hard cases of physics.md section 6: what each asks, and one function that runs it with any model, precision and choice of
// effects and gives figures with their bounds. The command bleedlab hardcases and tests/stability run the very same functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/sph/world.h"

namespace bleedsim::lab {

enum class EffectChoice {
  needed,  ///< what the case cannot do without
  all      ///< every effect that there is
};

struct CaseSetup {
  sph::Model model = sph::Model::sound;
  sph::Precision precision = sph::Precision::float32;
  EffectChoice effects = EffectChoice::needed;
  bool timed = false;  ///< measure also what only a clock can tell
};

/// A number and the range that it must lie in.
struct HardFigure {
  std::string name;
  double value = 0.0;
  double lowest = 0.0, highest = 0.0;  ///< infinite: no such bound
  bool judged = true;                  ///< false: told for information

  /// A value that is no number holds nothing.
  bool holds() const { return !judged || (value >= lowest && value <= highest); }
};

struct HardOutcome {
  std::vector<HardFigure> figures;                                                      ///< of the case
  std::vector<HardFigure> always;                                                       ///< physics.md section 6, "always"
  std::array<std::uint64_t, static_cast<std::size_t>(sph::Counter::count)> counters{};  ///< of all its worlds
  std::string stopped;  ///< why it ended early: a refusal or a fault; empty if it ran to its end

  bool holds() const;
};

class CaseRun;

struct HardCase {
  int number = 0;         ///< in physics.md
  std::string_view name;  ///< letters, digits and underscores
  std::string_view asks;
  void (*run)(CaseRun&) = nullptr;
};

/// By rising number.
std::span<const HardCase> hardCases();

HardOutcome runHardCase(const HardCase& hard_case, const CaseSetup& setup);

}  // namespace bleedsim::lab
