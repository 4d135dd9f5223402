// What each effect costs: time per particle and step, and memory per particle, one effect on at a time and one off at a time.
//
// All variants are measured on the same body of blood, a pool in an open box at the scene's spacing, support radius, kernel and
// fluid, in turns, so that a busy machine slows all of them alike; a figure is the median over the turns. Every variant takes
// steps as long as its own stability allows, lists renewed and implicit systems solved as in a session; dt tells what an effect
// costs by shorter steps. The pool settles by micrometres meanwhile, so the variants keep nearly the same neighbours; a pool
// without any viscosity boils a little and pays for it in renewed lists.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/sph/world.h"
#include "service/status/status.h"

namespace bleedsim::lab {

struct CostOptions {
  std::uint32_t particles = 8000;  ///< about; the pool is 16 deep
  int threads = 1;
  sph::SimdTarget simd = sph::SimdTarget::automatic;
  int turns = 7;
  int steps = 10;  ///< in a turn
};

/// One set of effects.
struct VariantCost {
  double microseconds = 0.0;  ///< per particle and step
  double bytes = 0.0;         ///< per particle, neighbour lists apart
  double list_bytes = 0.0;    ///< per particle
  double dt = 0.0;            ///< of the last step before the measured ones, s: an effect may ask for shorter ones
};

struct EffectCost {
  std::string name;
  bool in_scene = false;
  std::optional<VariantCost> alone;    ///< beside gravity and pressure; none if the solver refuses it
  std::optional<VariantCost> without;  ///< all effects of the scene but this one; none where the scene lacks it
  std::string refusal;                 ///< why there is no figure
};

struct EffectCosts {
  std::uint32_t particles = 0;
  std::string simd;
  VariantCost base;   ///< gravity and pressure
  VariantCost scene;  ///< all effects of the scene
  std::vector<EffectCost> effects;
};

/// `progress` is told what is done, 0 to 1. The scene's own wounds, tissue and domain are not used.
Result<EffectCosts> measureEffectCosts(const sph::WorldDescription& scene, const CostOptions& options,
                                       const std::function<void(double)>& progress);

}  // namespace bleedsim::lab
