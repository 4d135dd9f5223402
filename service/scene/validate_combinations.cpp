// What of a scene cannot work together. The reasons are short: a reply has room for 127 bytes.
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>

#include "service/scene/auto_effects.h"
#include "service/scene/effect_names.h"
#include "service/scene/nearest_name.h"
#include "service/scene/validate.h"
#include "service/sph/effects/literal_core_radius.h"

namespace bleedsim::scene {
namespace {

/// Why an effect needs Wendland C2; empty if it does not.
std::string_view whyNotSpline(std::string_view effect) {
  if (effect == "surface_tension") return "its factor and cut-off are fitted with it";
  if (effect == "platelets" || effect == "core_radius" || effect == "repulsion") {
    return "the spline's sums are built without it, to bound the build";
  }
  return {};
}

void validateSpline(const Effects& effects, ProblemList& problems) {
  const auto refuse = [&problems](const std::string& path, std::string_view why) {
    problems.add(path, fmt::format("needs kernel WENDLAND_C2, because {}", why));
  };
  for (const std::string& name : enabledEffects(effects)) {
    if (const std::string_view why = whyNotSpline(name); !why.empty()) refuse("effects." + name, why);
  }
  if (!effects.has_viscosity()) return;
  constexpr std::string_view kShearRate = "the shear rate is summed with it";
  if (effects.viscosity().has_carreau_yasuda()) refuse("effects.viscosity.carreau_yasuda", kShearRate);
  if (effects.viscosity().has_casson()) refuse("effects.viscosity.casson", kShearRate);
  if (effects.viscosity().solve() == Viscosity::IMPLICIT)
    refuse("effects.viscosity.solve", "the implicit sweeps are made for it");
}

void validatePlatelets(const Scene& scene, ProblemList& problems) {
  const Effects& effects = scene.effects();
  if (!effects.has_viscosity()) {
    problems.add("effects.platelets", "needs viscosity, there is nothing to thicken; add viscosity {} or drop platelets");
    return;
  }
  const Viscosity& viscosity = effects.viscosity();
  if (viscosity.has_viscosity_pa_s() && viscosity.viscosity_pa_s() == 0.0) {
    problems.add("effects.platelets", "needs a viscosity above 0, which it multiplies; set viscosity_pa_s");
  }
  const double fresh = viscosity.has_carreau_yasuda() ? viscosity.carreau_yasuda().zero_shear_pa_s()
                       : viscosity.has_casson()       ? viscosity.casson().plastic_viscosity_pa_s()
                                                      : viscosity.viscosity_pa_s();
  if (scene.model() == Scene::LITERAL) {
    if (!scene.literal().has_thickening_exponent() && scene.literal().thickening_pa_s() < fresh) {
      problems.add("literal.thickening_pa_s", fmt::format("value {} is below fresh blood's, {} (Pa s): a clot is thicker",
                                                          scene.literal().thickening_pa_s(), fresh));
    }
  } else if (effects.platelets().clot_viscosity_pa_s() < fresh) {
    problems.add("effects.platelets.clot_viscosity_pa_s",
                 fmt::format("value {} is below fresh blood's, {} (Pa s): a clot is thicker",
                             effects.platelets().clot_viscosity_pa_s(), fresh));
  }
}

void validatePeriodicReach(const Scene& scene, ProblemList& problems) {
  const Domain& domain = scene.domain();
  const double ratio = scene.resolution().support_ratio();
  const bool literal = scene.model() == Scene::LITERAL;
  const double largest = literal ? sph::literalRadiusBounds(ratio).largest : scene.effects().core_radius().largest();
  const double reach = scene.resolution().spacing_m() * ratio * largest;
  const auto require = [&](char axis, bool periodic, double side) {
    if (!periodic || side >= kMinPeriodicSide * reach) return;
    problems.add(literal ? "effects.core_radius" : "effects.core_radius.largest",
                 fmt::format("three of its reaches are {:.4g} m, the periodic side {} is {:.4g} m; widen the domain",
                             kMinPeriodicSide * reach, axis, side));
  };
  require('x', domain.periodic_x(), domain.upper_m().x() - domain.lower_m().x());
  require('y', domain.periodic_y(), domain.upper_m().y() - domain.lower_m().y());
  require('z', domain.periodic_z(), domain.upper_m().z() - domain.lower_m().z());
}

void validateTissueNeeds(const Scene& scene, ProblemList& problems) {
  if (scene.tissue_size() > 0) return;
  if (scene.effects().has_adhesion()) {
    problems.add("effects.adhesion", "needs tissue to stick to; add tissue {...} or drop adhesion");
  }
  if (scene.effects().has_surface_tension() && scene.effects().surface_tension().has_contact_angle_deg()) {
    problems.add("effects.surface_tension.contact_angle_deg", "needs tissue to meet; add tissue {...} or drop the angle");
  }
}

void validateAuto(const Scene& scene, ProblemList& problems) {
  const Effects& effects = scene.effects();
  const int count = requireCount("effects.auto", effects.auto__size(), kMaxAttributes, problems);
  const std::vector<std::string>& known = autoNames();
  for (int i = 0; i < count; ++i) {
    const std::string& name = effects.auto_(i);
    const std::string path = fmt::format("effects.auto[{}]", i);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      std::string shown;
      for (const char c : name.substr(0, 32)) shown += c >= ' ' && c <= '~' ? c : '?';
      const std::string nearest = nearestName(name, known);
      problems.add(path, nearest.empty() ? fmt::format("'{}' is unknown; known are {}", shown, fmt::join(known, ", "))
                                         : fmt::format("'{}' is unknown; did you mean '{}'?", shown, nearest));
    } else if (name == kAutoTension && !effects.has_surface_tension()) {
      problems.add(path, "there is no surface_tension to decide about; add it or drop the name");
    } else if (name == kAutoPlatelets && !effects.has_platelets()) {
      problems.add(path, "there are no platelets to decide about; add them or drop the name");
    } else if (name == kAutoPlatelets && !scene.has_horizon_s()) {
      problems.add(path, "platelets are judged by horizon_s, which is missing; add it");
    } else if (name == kAutoImplicit && !effects.has_viscosity()) {
      problems.add(path, "there is no viscosity to decide about; add it or drop the name");
    } else if (name == kAutoImplicit && (scene.domain().planar() || scene.resolution().kernel() == Resolution::CUBIC_SPLINE)) {
      problems.add(path, "viscosity is explicit here, because the implicit sweeps are made for Wendland C2 in space; drop it");
    } else if (name == kAutoImplicit && effects.viscosity().solve() == Viscosity::EXPLICIT) {
      problems.add(path, "effects.viscosity.solve is EXPLICIT already; drop one of the two");
    }
  }
}

}  // namespace

void validateCombinations(const Scene& scene, ProblemList& problems) {
  const Effects& effects = scene.effects();
  if (scene.resolution().kernel() == Resolution::CUBIC_SPLINE) validateSpline(effects, problems);
  if (effects.has_platelets()) validatePlatelets(scene, problems);
  if (effects.has_core_radius()) validatePeriodicReach(scene, problems);
  validateTissueNeeds(scene, problems);
  if (scene.model() == Scene::SOUND) validateAuto(scene, problems);
}

}  // namespace bleedsim::scene
