// The orifice law (physics.md sections 2 and 5.11), and what a wound may ask of the scene's speed of sound.
#pragma once

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// Cd sqrt(2 dp / rho), m/s. 0 unless the pressure drop (Pa) is positive.
double orificeSpeed(double pressure_drop, double discharge_coefficient, double rest_density);

/// The flow that a drive makes through `area` m^2, m^3/s.
double driveFlow(const WoundDrive& drive, double area, double rest_density);

/// invalid_argument unless: flow finite, >= 0; inlet pressure finite, >= 0; discharge coefficient in (0, 1].
Status checkDrive(const WoundDrive& drive);

struct ColumnSpeed {
  double speed = 0.0;  ///< of the particle column along the normal, m/s
  double limit = 0.0;  ///< c0 / mach_factor, the speed that the scene is made for, m/s
};

/// A column faster than the scene's limit would compress blood by more than mach_factor allows: invalid_argument with the
/// speed, the limit, the design_speed_m_per_s that the scene would need and the flow or pressure that would be accepted.
Status checkSpeed(const ColumnSpeed& column, const WoundDrive& drive);

}  // namespace bleedsim::sph
