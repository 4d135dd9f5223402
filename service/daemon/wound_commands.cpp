#include "service/daemon/wound_commands.h"

#include <limits>

#include "service/scene/feature_size.h"

namespace bleedsim::daemon {

std::optional<sph::Command> woundCommand(const dds::Action& action) {
  if (const auto* add = std::get_if<sph::AddWound>(&action)) return *add;
  if (const auto* update = std::get_if<sph::UpdateWound>(&action)) return *update;
  if (const auto* remove = std::get_if<sph::RemoveWound>(&action)) return *remove;
  return std::nullopt;
}

double patchWidthOf(const sph::Command& command) {
  if (const auto* add = std::get_if<sph::AddWound>(&command)) return scene::patchWidth(add->wound.shape);
  const auto* update = std::get_if<sph::UpdateWound>(&command);
  if (update != nullptr && update->shape) return scene::patchWidth(*update->shape);
  return std::numeric_limits<double>::infinity();
}

}  // namespace bleedsim::daemon
