#include <cmath>
#include <fmt/format.h>
#include <string>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

void validateOutput(const Scene& scene, ProblemList& problems) {
  const Output& output = scene.output();
  problems.requireInRange("output.frame_rate_hz", output.frame_rate_hz(), kFrameRate);
  const int count = requireCount("output.attributes", output.attributes_size(), kMaxAttributes, problems);
  for (int i = 0; i < count; ++i) {
    const int value = output.attributes(i);
    if (!Output::Attribute_IsValid(value)) {
      problems.add("output.attributes", fmt::format("value {} is unknown, known are VELOCITY, DENSITY, VISCOSITY", value));
    } else if (value == Output::NONE && output.attributes_size() > 1) {
      problems.add("output.attributes", "NONE stands beside other attributes; drop it or them");
    } else if (value == Output::VISCOSITY && !scene.effects().has_viscosity()) {
      problems.add("output.attributes",
                   "VISCOSITY needs the viscosity effect; add effects { viscosity {} } or drop the attribute");
    }
  }
}

}  // namespace

void validateEffects(const Scene& scene, ProblemList& problems) {
  const Effects& effects = scene.effects();
  if (effects.has_gravity()) {
    const Vec3& g = effects.gravity().acceleration_m_per_s2();
    problems.requireInRange("effects.gravity.acceleration_m_per_s2", std::hypot(g.x(), g.y(), g.z()), kGravity);
  }
  if (effects.has_pressure()) {
    problems.requireInRange("effects.pressure.background_pressure_pa", effects.pressure().background_pressure_pa(),
                            kBackgroundPressure);
  }
  if (effects.has_viscosity()) {
    problems.requireInRange("effects.viscosity.viscosity_pa_s", effects.viscosity().viscosity_pa_s(), kViscosity);
  }
  if (effects.has_applied_force()) {
    problems.requireInRange("effects.applied_force.max_sources", effects.applied_force().max_sources(), kMaxSources);
  }
  validateOutput(scene, problems);
  problems.requireInRange("commands.instrument_expiry_s", scene.commands().instrument_expiry_s(), kInstrumentExpiry);
  problems.requireInRange("commands.max_wounds", scene.commands().max_wounds(), kMaxWounds);
}

}  // namespace bleedsim::scene
