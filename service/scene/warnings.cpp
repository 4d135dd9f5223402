#include "service/scene/warnings.h"

#include <fmt/format.h>

namespace bleedsim::scene {
namespace {

// Drops of thin blood at rest: Laplace's pressure within 30 % at 2.5 and 5 % at 3, boiling at 2.
constexpr double kTensionSupport = 2.5;

}  // namespace

std::vector<std::string> findWarnings(const sph::WorldDescription& world) {
  std::vector<std::string> warnings;
  if (world.model == sph::Model::sound && world.effects.surface_tension && world.support_ratio < kTensionSupport) {
    warnings.push_back(fmt::format("warning: surface_tension: drops boil at support_ratio {:g}; use {:g} or more",
                                   world.support_ratio, kTensionSupport));
  }
  return warnings;
}

}  // namespace bleedsim::scene
