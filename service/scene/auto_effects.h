// `effects.auto`: which effects a scene may do without, because they provably cannot matter in it.
//
// rule               | left out when                                    | figures
// surface_tension    | smallest feature > 3 capillary lengths           | l_c = sqrt(sigma/(rho g)), m; never without gravity
// platelets          | horizon_s < 1 % of the clotting time             | s until P of the fastest place is 1/2
// implicit_viscosity | 0.045 h^2 rho/mu_max not below another dt limit  | s; the solver's limits (time_step.h), at rest
//
// A feature is what blood gets a size by: the narrowest place of a wound's patch (feature_size.h), those that came by command
// included, the shortest side of a fluid block or of box tissue, the depth and radius of a bowl. Tension shapes blood below about
// l_c; at 3 l_c the hydrostatic pressure across the feature is nine times the capillary one, (feature/l_c)^2.
//
// Only in the sound model. Of the literal one nothing of this can be shown: the force of (22) is O(1) wrong and acts on a flat
// surface as well, whatever its size; (26) sets the viscosity from the start, clotting or not; viscosity is never implicit.
#pragma once

#include <limits>
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

/// What a session that runs the scene knows beyond it.
struct Session {
  double speed_of_sound = 0.0;                                       ///< m/s, kept whatever is switched
  double narrowest_wound = std::numeric_limits<double>::infinity();  ///< m, of all patches that came by command
};

/// Features up to this size need tension, 3 l_c, m; infinite without gravity. The description must have the effect.
double tensionReach(const sph::WorldDescription& world);

/// One decision. The effect must be among the description's; `horizon` in s, `narrowest_wound` as in Session.
AutoDecision decideTension(const sph::WorldDescription& world, double narrowest_wound = std::numeric_limits<double>::infinity());
AutoDecision decidePlatelets(const sph::WorldDescription& world, double horizon);
AutoDecision decideImplicitViscosity(const sph::WorldDescription& world, double speed_of_sound);

/// Takes the named decisions and leaves the effects out that need not be. Without a session, as it will begin.
std::vector<AutoDecision> applyAuto(const std::vector<std::string>& names, std::optional<double> horizon,
                                    const std::optional<Session>& session, sph::WorldDescription& world);

}  // namespace bleedsim::scene
