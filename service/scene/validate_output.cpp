#include <fmt/format.h>
#include <string_view>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

void validateAttribute(const Scene& scene, int value, ProblemList& problems) {
  const auto need = [&](bool present, std::string_view attribute, std::string_view effect) {
    if (present) return;
    problems.add("output.attributes", fmt::format("{} needs the {} effect; add effects {{ {} {{}} }} or drop the attribute",
                                                  attribute, effect, effect));
  };
  if (!Output::Attribute_IsValid(value)) {
    problems.add("output.attributes",
                 fmt::format("value {} is unknown, known are VELOCITY, DENSITY, VISCOSITY, PLATELET, RADIUS", value));
  } else if (value == Output::NONE && scene.output().attributes_size() > 1) {
    problems.add("output.attributes", "NONE stands beside other attributes; drop it or them");
  } else if (value == Output::VISCOSITY) {
    need(scene.effects().has_viscosity(), "VISCOSITY", "viscosity");
  } else if (value == Output::PLATELET) {
    need(scene.effects().has_platelets(), "PLATELET", "platelets");
  } else if (value == Output::RADIUS) {
    need(scene.effects().has_core_radius(), "RADIUS", "core_radius");
  }
}

}  // namespace

void validateOutput(const Scene& scene, ProblemList& problems) {
  const Output& output = scene.output();
  problems.requireInRange("output.frame_rate_hz", output.frame_rate_hz(), kFrameRate);
  const int count = requireCount("output.attributes", output.attributes_size(), kMaxAttributes, problems);
  for (int i = 0; i < count; ++i) validateAttribute(scene, output.attributes(i), problems);
  problems.requireInRange("commands.instrument_expiry_s", scene.commands().instrument_expiry_s(), kInstrumentExpiry);
  problems.requireInRange("commands.max_wounds", scene.commands().max_wounds(), kMaxWounds);
}

}  // namespace bleedsim::scene
