#include "service/scene/sound_only.h"

#include <array>
#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <string>
#include <string_view>

#include "service/scene/effect_names.h"

namespace bleedsim::scene {
namespace {

struct SoundOnly {
  std::string_view effect;
  std::string_view field;
  std::string_view instead;  ///< what to do under model LITERAL, with the reason where there is no counterpart
};

constexpr std::string_view kNoSinks = "leave it out, because (27) only spreads P and nothing lowers it";
constexpr std::string_view kOwnBounds = "leave it out, because the printed (34) has neither bounds nor relaxation";
constexpr std::string_view kExplicit = "leave it out, because the printed (25) is solved explicitly";

constexpr std::array<SoundOnly, 21> kSoundOnly{{
    {"pressure", "form", "set literal.pressure"},
    {"viscosity", "solve_tolerance", kExplicit},
    {"viscosity", "max_iterations", kExplicit},
    {"surface_tension", "sigma_n_per_m", "set literal.tension_n_per_m"},
    {"surface_tension", "temperature_c", "set literal.tension_n_per_m"},
    {"surface_tension", "normal_cutoff", "set literal.normal_cutoff"},
    {"platelets", "diffusivity_m2_per_s", "set literal.platelet_diffusivity_m2_per_s"},
    {"platelets", "activation_rate_per_s", kNoSinks},
    {"platelets", "wall_rate_per_s", kNoSinks},
    {"platelets", "air_rate_per_s", kNoSinks},
    {"platelets", "shear_gate_per_s", kNoSinks},
    {"platelets", "clot_speedup", kNoSinks},
    {"platelets", "clot_viscosity_pa_s", "set literal.thickening_pa_s"},
    {"core_radius", "smallest", kOwnBounds},
    {"core_radius", "largest", kOwnBounds},
    {"core_radius", "relaxation", kOwnBounds},
    {"repulsion", "strength", "set literal.repulsion_n_m2"},
    {"repulsion", "contact_distance", "set literal.contact_radius, half of it"},
    {"repulsion", "power_1", "set literal.power_1"},
    {"repulsion", "power_2", "set literal.power_2"},
    {"repulsion", "damping", "leave it out, because (36) has no damping"},
}};

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const FieldDescriptor* fieldOf(const Message& effect, std::string_view name) {
  return effect.GetDescriptor()->FindFieldByName(std::string{name});
}

bool has(const Effects& effects, const SoundOnly& row) {
  const FieldDescriptor* effect = findEffect(row.effect);
  if (!effects.GetReflection()->HasField(effects, effect)) return false;
  const Message& settings = effects.GetReflection()->GetMessage(effects, effect);
  return settings.GetReflection()->HasField(settings, fieldOf(settings, row.field));
}

}  // namespace

void dropSoundOnlyDefaults(const Effects& written, Effects& filled) {
  for (const SoundOnly& row : kSoundOnly) {
    if (has(written, row) || !has(filled, row)) continue;
    Message& settings = *filled.GetReflection()->MutableMessage(&filled, findEffect(row.effect));
    settings.GetReflection()->ClearField(&settings, fieldOf(settings, row.field));
  }
}

void refuseSoundOnly(const Effects& effects, ProblemList& problems) {
  for (const SoundOnly& row : kSoundOnly) {
    if (has(effects, row)) {
      problems.add(fmt::format("effects.{}.{}", row.effect, row.field), fmt::format("is of model SOUND; {}", row.instead));
    }
  }
}

}  // namespace bleedsim::scene
