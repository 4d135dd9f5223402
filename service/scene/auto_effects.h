// `effects.auto`: which effects a scene may do without, because they provably cannot matter in it.
//
// rule               | left out when                                    | figures
// surface_tension    | smallest feature > 3 capillary lengths           | l_c = sqrt(sigma/(rho g)), m; never without gravity
// platelets          | horizon_s < 1 % of the clotting time             | s until P of the fastest place, at tissue and air, is
// 1/2 implicit_viscosity | 0.045 h^2 rho/mu_max not below another dt limit  | s; the solver's limits (time_step.h), at rest
//
// A feature is what the scene gives blood a size by: the narrow side of a wound's patch, the shortest side of a fluid block or of
// box tissue, the depth and radius of a bowl. Tension shapes blood below about l_c; at 3 l_c the hydrostatic pressure across
// the feature is nine times the capillary one, (feature/l_c)^2.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/sph/world_description.h"

namespace bleedsim::scene {

inline constexpr std::string_view kAutoTension = "surface_tension";
inline constexpr std::string_view kAutoPlatelets = "platelets";
inline constexpr std::string_view kAutoImplicit = "implicit_viscosity";

/// What `effects.auto` may name.
const std::vector<std::string>& autoNames();

struct AutoDecision {
  std::string name;
  bool enabled = true;
  std::string reason;  ///< with its figures
};

/// One decision. The effect must be among the description's; `horizon` in s.
AutoDecision decideTension(const sph::WorldDescription& world);
AutoDecision decidePlatelets(const sph::WorldDescription& world, double horizon);
AutoDecision decideImplicitViscosity(const sph::WorldDescription& world, double speed_of_sound);

/// Takes the named decisions and leaves the effects out that need not be. `speed_of_sound` in m/s is that of the session which
/// already runs the scene; without one, the scene's own.
std::vector<AutoDecision> applyAuto(const std::vector<std::string>& names, std::optional<double> horizon,
                                    std::optional<double> speed_of_sound, sph::WorldDescription& world);

}  // namespace bleedsim::scene
