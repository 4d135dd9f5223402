// The stable time step: physics.md section 2, "Time".
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace bleedsim::sph {

/// The constants of a scene that bound the step.
struct TimeStepLimits {
  double spacing = 0.0;                                        ///< dx, m
  double speed_of_sound = 0.0;                                 ///< c0, m/s
  double viscous = std::numeric_limits<double>::infinity();    ///< 0.045 h^2 rho0/mu, s; 0.06 goes unstable at walls
  double capillary = std::numeric_limits<double>::infinity();  ///< 0.25 sqrt(rho0 dx^3/(2 pi sigma)), s
  double diffusive = std::numeric_limits<double>::infinity();  ///< 0.045 h^2/k of the platelets, s
  double contact = 0.0;                                        ///< of repulsion, in dx/max(c0, v_rel); 0 without it
  double scene = std::numeric_limits<double>::infinity();      ///< max_dt, s
};

/// 0.4 dx/(c0 + v), s; v in m/s is the largest speed.
inline double acousticLimit(double spacing, double speed_of_sound, double max_speed = 0.0) {
  return 0.4 * spacing / (speed_of_sound + max_speed);
}

/// min(0.4 dx/(c0 + v), 0.25 sqrt(dx/a), viscous, capillary, diffusive, scene, 1.1 x the step before), s; v in m/s and a in m/s^2
/// are the largest of all particles. Repulsion adds contact dx/max(c0, v_rel), where no two particles close faster than v_rel =
/// 2 v. Fractions of a step are never taken to meet a frame, so results do not depend on the frame rate.
inline double stableTimeStep(const TimeStepLimits& limits, double max_speed, double max_acceleration, double before) {
  double dt = acousticLimit(limits.spacing, limits.speed_of_sound, max_speed);
  if (max_acceleration > 0.0) dt = std::min(dt, 0.25 * std::sqrt(limits.spacing / max_acceleration));
  if (limits.contact > 0.0) dt = std::min(dt, limits.contact * limits.spacing / std::max(limits.speed_of_sound, 2.0 * max_speed));
  return std::min({dt, limits.viscous, limits.capillary, limits.diffusive, limits.scene, 1.1 * before});
}

}  // namespace bleedsim::sph
