#include "service/daemon/wound_commands.h"

#include <utility>

#include "service/scene/feature_size.h"

namespace bleedsim::daemon {

std::optional<WoundCommand> woundCommand(const dds::Action& action) {
  const auto with_width = [](sph::Command command) {
    const double width = scene::patchWidthOf(command);
    return WoundCommand{std::move(command), width};
  };
  if (const auto* add = std::get_if<sph::AddWound>(&action)) return with_width(*add);
  if (const auto* update = std::get_if<sph::UpdateWound>(&action)) return with_width(*update);
  if (const auto* remove = std::get_if<sph::RemoveWound>(&action)) return with_width(*remove);
  return std::nullopt;
}

}  // namespace bleedsim::daemon
