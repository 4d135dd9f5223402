// What each effect costs: time per particle and step, and memory per particle, one effect on at a time and one off at a time.
//
// "On alone" is measured against the smallest set that the effect can run with: nothing at all, or the effects that it needs
// (platelets: viscosity). The first effect that looks at pairs pays for the search and the density there; what an effect adds to
// a scene that has both is the figure of "off alone": all effects of the scene, less that one and those that need it.
//
// All variants are measured on the same body of blood, a pool in an open box at the scene's spacing, support radius, kernel and
// fluid (a planar scene: a square sheet without tissue), in turns, so that a busy machine slows all of them alike. A difference
// is the median over the turns of the two variants' difference in one turn, its scatter the median absolute deviation. On one
// thread the clock is that of the thread's CPU time, which others on the machine hardly touch, on several the wall's. Every
// variant takes steps as long as its own stability allows, lists renewed and implicit systems solved as in a session; dt tells
// what an effect costs by shorter steps. The pool settles by micrometres meanwhile, so the variants keep nearly the same
// neighbours; a pool without any viscosity boils a little and pays for it in renewed lists.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/lab/measured.h"
#include "service/sph/world.h"
#include "service/status/status.h"

namespace bleedsim::lab {

inline constexpr int kLeastTurns = 3;  ///< whatever the time that they take: below that a scatter says nothing

struct CostOptions {
  std::uint32_t particles = 8000;  ///< about; the pool is 16 deep
  int threads = 1;
  sph::SimdTarget simd = sph::SimdTarget::automatic;
  double seconds = 10.0;  ///< wall time, preparation included, after which no further turn begins
  int steps = 10;         ///< in a turn
};

/// One set of effects.
struct VariantCost {
  Measured microseconds;    ///< per particle and step
  double bytes = 0.0;       ///< per particle, neighbour lists apart
  double list_bytes = 0.0;  ///< per particle
  double dt = 0.0;          ///< of the last step before the measured ones, s: an effect may ask for shorter ones
};

/// What one variant costs beyond another.
struct CostDifference {
  VariantCost cost;                 ///< of the variant that was run
  Measured microseconds;            ///< of the difference, per particle and step
  double bytes = 0.0;               ///< of the difference
  std::vector<std::string> others;  ///< on alone: the effects that it needs; off alone: those that need it, off as well

  /// Above twice the scatter; else the difference is noise.
  bool counts() const {
    return microseconds.value > 2.0 * microseconds.scatter || microseconds.value < -2.0 * microseconds.scatter;
  }
};

struct EffectCost {
  std::string name;
  bool in_scene = false;
  std::optional<CostDifference> alone;    ///< none if the solver refuses it
  std::optional<CostDifference> without;  ///< none where the scene lacks it
  std::string refusal;                    ///< why there is no figure
};

struct EffectCosts {
  std::uint32_t particles = 0;
  std::string simd;
  int turns = 0;
  bool cpu_time = true;  ///< else wall time
  VariantCost nothing;   ///< without any effect: what moves particles and keeps them in order
  VariantCost scene;     ///< all effects of the scene
  std::vector<EffectCost> effects;
};

/// `progress` is told what is done, 0 to 1. The scene's own wounds, tissue, domain and background pressure are not used.
Result<EffectCosts> measureEffectCosts(const sph::WorldDescription& scene, const CostOptions& options,
                                       const std::function<void(double)>& progress);

}  // namespace bleedsim::lab
