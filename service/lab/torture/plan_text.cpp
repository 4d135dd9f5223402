#include <algorithm>
#include <fmt/format.h>

#include "service/lab/torture/torture_plan.h"
#include "service/scene/read_text.h"

namespace bleedsim::lab {
namespace {

std::string textOf(const sph::Vec3& v) { return fmt::format("({:.17g} {:.17g} {:.17g})", v.x(), v.y(), v.z()); }

std::string textOf(const sph::WoundDrive& drive) {
  if (const auto* flow = std::get_if<sph::FlowDrive>(&drive)) return fmt::format("flow {:.17g} m^3/s", flow->flow);
  return fmt::format("inlet pressure {:.17g} Pa", std::get<sph::PressureDriveSettings>(drive).inlet_pressure);
}

/// Discs are all that plans have.
std::string textOf(const sph::PatchShape& shape) {
  const auto* disc = std::get_if<sph::DiscPatch>(&shape);
  return disc == nullptr ? std::string{} : fmt::format(" disc of {:.17g} m", disc->radius);
}

std::string textOf(const sph::UpdateWound& update) {
  std::string text = fmt::format("update wound {}", update.wound_id);
  if (update.position) text += fmt::format(" position {} m", textOf(*update.position));
  if (update.normal) text += fmt::format(" normal {}", textOf(*update.normal));
  if (update.shape) text += textOf(*update.shape);
  if (update.drive) text += fmt::format(" {}", textOf(*update.drive));
  return text;
}

std::string textOf(const sph::Command& command) {
  if (const auto* force = std::get_if<sph::SetForce>(&command)) {
    return fmt::format("force {} at {} m, radius {:.17g} m: {} N until {:.17g} s", force->key, textOf(force->position),
                       force->radius, textOf(force->force), force->until);
  }
  if (const auto* remove = std::get_if<sph::RemoveForce>(&command)) return fmt::format("remove force {}", remove->key);
  if (const auto* remove = std::get_if<sph::RemoveWound>(&command)) return fmt::format("remove wound {}", remove->wound_id);
  if (const auto* update = std::get_if<sph::UpdateWound>(&command)) return textOf(*update);
  const sph::WoundDescription& wound = std::get<sph::AddWound>(command).wound;
  return fmt::format("add wound at {} m, normal {},{}, {}", textOf(wound.position), textOf(wound.normal), textOf(wound.shape),
                     textOf(wound.drive));
}

/// In one line, which a comment is.
std::string textOf(const scene::EffectChange& change) {
  std::string text = fmt::format("effect {} {}", change.name, change.enabled ? "on" : "off");
  if (change.settings.empty()) return text;
  std::string settings = change.settings;
  std::replace(settings.begin(), settings.end(), '\n', ' ');
  return text + fmt::format(" with {{ {}}}", settings);
}

}  // namespace

std::string toText(const TorturePlan& plan) {
  std::string text = fmt::format("# bleedlab torture, scene of seed {}: {} steps in {} precision\n", plan.seed, plan.steps,
                                 plan.precision == sph::Precision::float32 ? "float32" : "double");
  for (const TimedCommand& timed : plan.commands)
    text += fmt::format("# before step {}: {}\n", timed.step, textOf(timed.command));
  for (const TimedChange& timed : plan.changes) text += fmt::format("# before step {}: {}\n", timed.step, textOf(timed.change));
  for (const TimedLimit& timed : plan.limits)
    text += fmt::format("# before step {}: steps of at most {:.17g} s\n", timed.step, timed.limit);
  return text + scene::writeText(plan.scene);
}

}  // namespace bleedsim::lab
