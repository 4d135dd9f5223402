// The orifice law (physics.md sections 2 and 5.11), and what a wound may ask of the scene's speed of sound.
#pragma once

#include <optional>

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// Cd sqrt(2 dp / rho), m/s. 0 unless the pressure drop (Pa) is positive.
double orificeSpeed(double pressure_drop, double discharge_coefficient, double rest_density);

/// The flow that a drive makes through `area` m^2, m^3/s.
double driveFlow(const WoundDrive& drive, double area, double rest_density);

/// invalid_argument unless flow, inlet pressure and discharge coefficient are in the ranges that scenes and requests have.
Status checkDrive(const WoundDrive& drive);

struct ColumnSpeed {
  double speed = 0.0;  ///< of the particle column along the normal, m/s
  double limit = 0.0;  ///< c0 / mach_factor, the speed that the scene is made for, m/s
};

/// What a drive that makes its column too fast may be instead, rounded so that it is accepted when typed in.
struct SpeedExcess {
  ColumnSpeed column;
  double most = 0.0;          ///< flow in mL/s or inlet pressure in mmHg
  double design_speed = 0.0;  ///< m/s, that the scene would need for the drive as it is
};

/// A column faster than the scene's limit would compress blood by more than mach_factor allows.
std::optional<SpeedExcess> speedExcess(const ColumnSpeed& column, const WoundDrive& drive);

/// ok, or invalid_argument with all that a SpeedExcess says.
Status checkSpeed(const ColumnSpeed& column, const WoundDrive& drive);

}  // namespace bleedsim::sph
