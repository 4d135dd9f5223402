// Runs random scenes, checks what must always hold, and makes the scene small that breaks it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "service/lab/torture/torture_plan.h"

namespace bleedsim::lab {

struct TortureOutcome {
  bool refused = false;  ///< the scene is not valid; `text` says why
  bool holds = true;
  std::string text;  ///< what did not hold
  std::uint64_t particle_steps = 0;
  std::uint64_t switched = 0;      ///< changes of effects that were taken
  std::uint64_t not_switched = 0;  ///< that were refused
  std::array<std::uint64_t, static_cast<std::size_t>(sph::Counter::count)> counters{};
};

/// What always holds is checked after every step. The literal model may fault, a sound world must not.
TortureOutcome runPlan(const TorturePlan& plan);

/// Drops and halves parts of the plan as long as it still fails, with at most `tries` runs. Every part that is left is needed for
/// the failure, unless the tries ran out.
TorturePlan shrink(TorturePlan plan, const std::function<bool(const TorturePlan&)>& fails, int tries = 300);

}  // namespace bleedsim::lab
