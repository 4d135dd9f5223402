#include "service/daemon/inspect.h"

#include <fmt/core.h>

namespace bleedsim::daemon {

namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

bool acts(const scene::SceneDescription& description, std::string_view effect) {
  return sph::effectEnabled(description.world, effect);
}

}  // namespace

void printEffects(const scene::SceneDescription* description, bool json) {
  const char* separator = "";
  if (json) fmt::print("[");
  for (const sph::EffectInfo& effect : sph::effectCatalog()) {
    const bool on = description != nullptr && acts(*description, effect.name);
    if (json) {
      const std::string state = description == nullptr ? "" : fmt::format("\"on\": {}, ", on);
      fmt::print("{}{{\"name\": {}, {}\"equation\": {}, \"source\": {}, \"deviation\": {}, \"literal\": {}}}", separator,
                 quoted(effect.name), state, quoted(effect.equation), quoted(effect.source), quoted(effect.deviation),
                 quoted(effect.literal));
      separator = ", ";
      continue;
    }
    const std::string_view state = description == nullptr ? "" : on ? "on   " : "off  ";
    fmt::print("{}{:<16} {}\n", state, effect.name, effect.equation);
    const std::size_t indent = state.size() + 17;
    if (!effect.source.empty()) fmt::print("{:>{}}source: {}\n", "", indent, effect.source);
    if (!effect.deviation.empty()) fmt::print("{:>{}}deviation: {}\n", "", indent, effect.deviation);
    if (!effect.literal.empty()) fmt::print("{:>{}}literal: {}\n", "", indent, effect.literal);
  }
  if (json) fmt::print("]\n");
  if (json || description == nullptr) return;
  for (const std::string& decision : description->decisions) fmt::print("{}\n", decision);
}

void printWorld(const LoadedScene& loaded) {
  const sph::WorldDescription& description = loaded.scene->world;
  fmt::print("scene '{}' is valid\n", loaded.scene->name);
  fmt::print("  particles {} at the start, capacity {}, spacing {:g} mm\n", loaded.world->particleCount(), description.capacity,
             description.spacing * 1e3);
  fmt::print("  wounds {}, tissue {}, fluid blocks {}\n", description.wounds.size(), description.tissue.size(),
             description.fluid_blocks.size());
  for (const std::string& decision : loaded.scene->decisions) fmt::print("  {}\n", decision);
  fmt::print("  speed of sound {:g} m/s, SIMD target {}\n", loaded.world->speedOfSound(),
             sph::simdTargetName(loaded.world->simdTarget()));
}

}  // namespace bleedsim::daemon
