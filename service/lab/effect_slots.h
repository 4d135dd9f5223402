// The effects of a scene by name, so that one can be taken out or put in alone.
#pragma once

#include <array>
#include <string_view>

#include "service/sph/effect_settings.h"

namespace bleedsim::lab {

struct EffectSlot {
  std::string_view name;
  bool (*present)(const sph::EffectSettings& settings);
  void (*remove)(sph::EffectSettings& settings);
  /// Takes the effect from `source`, or with its defaults if that lacks it.
  void (*add)(sph::EffectSettings& settings, const sph::EffectSettings& source);
};

template <auto kMember>
constexpr EffectSlot effectSlot(std::string_view name) {
  return {name, [](const sph::EffectSettings& settings) { return (settings.*kMember).has_value(); },
          [](sph::EffectSettings& settings) { (settings.*kMember).reset(); },
          [](sph::EffectSettings& settings, const sph::EffectSettings& source) {
            if (source.*kMember)
              settings.*kMember = source.*kMember;
            else
              (settings.*kMember).emplace();
          }};
}

/// In the order in which they act.
inline constexpr std::array kEffectSlots{
    effectSlot<&sph::EffectSettings::gravity>("gravity"),
    effectSlot<&sph::EffectSettings::pressure>("pressure"),
    effectSlot<&sph::EffectSettings::viscosity>("viscosity"),
    effectSlot<&sph::EffectSettings::surface_tension>("surface_tension"),
    effectSlot<&sph::EffectSettings::platelets>("platelets"),
    effectSlot<&sph::EffectSettings::core_radius>("core_radius"),
    effectSlot<&sph::EffectSettings::repulsion>("repulsion"),
    effectSlot<&sph::EffectSettings::adhesion>("adhesion"),
    effectSlot<&sph::EffectSettings::applied_force>("applied_force"),
};

}  // namespace bleedsim::lab
