#include "service/daemon/inspect.h"

#include <fmt/format.h>
#include <iterator>
#include <vector>

namespace bleedsim::daemon {
namespace {

std::string inQuotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string_view stateOf(const scene::SceneDescription* description, std::string_view effect) {
  if (description == nullptr) return "available";
  return sph::effectEnabled(description->world, effect) ? "on" : "off";
}

std::string jsonList(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + inQuotes(text);
  return "[" + out + "]";
}

std::string listAsJson(const scene::SceneDescription* description) {
  std::string rows;
  for (const sph::EffectInfo& effect : sph::effectCatalog()) {
    fmt::format_to(std::back_inserter(rows),
                   "{}{{\"name\": {}, \"state\": {}, \"equation\": {}, \"source\": {}, \"deviation\": {}, \"literal\": {}}}",
                   rows.empty() ? "" : ", ", inQuotes(effect.name), inQuotes(stateOf(description, effect.name)),
                   inQuotes(effect.equation), inQuotes(effect.source), inQuotes(effect.deviation), inQuotes(effect.literal));
  }
  const std::vector<std::string> none;
  return fmt::format("{{\"effects\": [{}], \"decisions\": {}, \"warnings\": {}}}\n", rows,
                     jsonList(description == nullptr ? none : description->decisions),
                     jsonList(description == nullptr ? none : description->warnings));
}

}  // namespace

std::string listEffects(const scene::SceneDescription* description, bool json) {
  if (json) return listAsJson(description);
  std::string out;
  const auto to = std::back_inserter(out);
  for (const sph::EffectInfo& effect : sph::effectCatalog()) {
    fmt::format_to(to, "{:<9}  {:<16} {}\n", stateOf(description, effect.name), effect.name, effect.equation);
    fmt::format_to(to, "{:28}source: {}\n{:28}deviation: {}\n", "", effect.source, "", effect.deviation);
    if (!effect.literal.empty()) fmt::format_to(to, "{:28}literal: {}\n", "", effect.literal);
  }
  if (description == nullptr) return out;
  for (const std::string& note : description->warnings) out += note + "\n";
  for (const std::string& note : description->decisions) out += note + "\n";
  return out;
}

std::string describeWorld(const LoadedScene& loaded) {
  const sph::WorldDescription& description = loaded.scene->world;
  std::string out = fmt::format("scene '{}' is valid\n", loaded.scene->name);
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "  particles {} at the start, capacity {}, spacing {:g} mm\n", loaded.world->particleCount(),
                 description.capacity, description.spacing * 1e3);
  fmt::format_to(to, "  wounds {}, tissue {}, fluid blocks {}\n", description.wounds.size(), description.tissue.size(),
                 description.fluid_blocks.size());
  for (const std::string& note : loaded.scene->warnings) fmt::format_to(to, "  {}\n", note);
  for (const std::string& note : loaded.scene->decisions) fmt::format_to(to, "  {}\n", note);
  fmt::format_to(to, "  speed of sound {:g} m/s, SIMD target {}\n", loaded.world->speedOfSound(),
                 sph::simdTargetName(loaded.world->simdTarget()));
  return out;
}

}  // namespace bleedsim::daemon
