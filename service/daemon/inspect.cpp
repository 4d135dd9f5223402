#include "service/daemon/inspect.h"

#include <fmt/core.h>

namespace bleedsim::daemon {

void printEffects(const scene::SceneDescription* description) {
  for (const sph::EffectInfo& effect : sph::effectCatalog()) {
    const bool enabled = description != nullptr && sph::effectEnabled(description->world, effect.name);
    const std::string_view state = description == nullptr ? "" : enabled ? "on   " : "off  ";
    fmt::print("{}{:<14} {}\n", state, effect.name, effect.equation);
    if (!effect.source.empty()) fmt::print("{:>21}source: {}\n", "", effect.source);
    if (!effect.deviation.empty()) fmt::print("{:>21}deviation: {}\n", "", effect.deviation);
    if (!effect.literal.empty()) fmt::print("{:>21}literal: {}\n", "", effect.literal);
  }
}

void printWorld(const LoadedScene& loaded) {
  const sph::WorldDescription& description = loaded.scene->world;
  fmt::print("scene '{}' is valid\n", loaded.scene->name);
  fmt::print("  particles {} at the start, capacity {}, spacing {:g} mm\n", loaded.world->particleCount(), description.capacity,
             description.spacing * 1e3);
  fmt::print("  wounds {}, tissue {}, fluid blocks {}\n", description.wounds.size(), description.tissue.size(),
             description.fluid_blocks.size());
  fmt::print("  speed of sound {:g} m/s, SIMD target {}\n", loaded.world->speedOfSound(),
             sph::simdTargetName(loaded.world->simdTarget()));
}

}  // namespace bleedsim::daemon
