#include "service/sph/wound/orifice.h"

#include <cmath>
#include <string>

#include "service/sph/wound/text.h"
#include "service/status/quantity_limits.h"
#include "service/status/units.h"

namespace bleedsim::sph {
namespace {

/// invalid_argument unless `value` is in the range, whose unit is `unit` of the value's own.
Status checkRange(const char* name, double value, const Range& range, double unit) {
  if (value >= range.lower * unit && value <= range.upper * unit) return {};  // false for NaN
  const std::string space = range.unit.empty() ? "" : " ";
  return {StatusCode::invalid_argument, textOf("wound ", name, " is ", value / unit, space, range.unit, "; allowed are ",
                                               range.lower, " to ", range.upper, space, range.unit)};
}

/// For a person to type back: three digits, rounded the way that is accepted.
double roundedDown(double value) {
  if (!(value > 0.0)) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return std::floor(value / unit + 1e-6) * unit;
}
double roundedUp(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return std::ceil(value / unit - 1e-6) * unit;
}

}  // namespace

double orificeSpeed(double pressure_drop, double discharge_coefficient, double rest_density) {
  if (!(pressure_drop > 0.0)) return 0.0;
  return discharge_coefficient * std::sqrt(2.0 * pressure_drop / rest_density);
}

double driveFlow(const WoundDrive& drive, double area, double rest_density) {
  if (const auto* flow = std::get_if<FlowDrive>(&drive)) return flow->flow;
  const auto& pressure = std::get<PressureDriveSettings>(drive);
  return orificeSpeed(pressure.inlet_pressure, pressure.discharge_coefficient, rest_density) * area;
}

Status checkDrive(const WoundDrive& drive) {
  if (const auto* flow = std::get_if<FlowDrive>(&drive)) return checkRange("flow", flow->flow, kFlow, kCubicMetresPerMl);
  const auto& pressure = std::get<PressureDriveSettings>(drive);
  if (Status status = checkRange("inlet pressure", pressure.inlet_pressure, kInletPressure, kPascalsPerMmHg); !status)
    return status;
  return checkRange("discharge coefficient", pressure.discharge_coefficient, kDischargeCoefficient, 1.0);
}

std::optional<SpeedExcess> speedExcess(const ColumnSpeed& column, const WoundDrive& drive) {
  // A scene whose own inlet pressure set the limit must not be refused for a rounding error.
  if (column.speed <= column.limit * (1.0 + 1e-9)) return std::nullopt;
  const double ratio = column.limit / column.speed;
  const auto* flow = std::get_if<FlowDrive>(&drive);
  const double most = flow != nullptr ? mlFromCubicMetres(flow->flow * ratio)
                                      : mmHgFromPascals(std::get<PressureDriveSettings>(drive).inlet_pressure * ratio * ratio);
  return SpeedExcess{column, roundedDown(most), roundedUp(column.speed)};
}

Status checkSpeed(const ColumnSpeed& column, const WoundDrive& drive) {
  const std::optional<SpeedExcess> excess = speedExcess(column, drive);
  if (!excess) return {};
  const bool flow = std::holds_alternative<FlowDrive>(drive);
  return {StatusCode::invalid_argument,
          // A reply holds 127 bytes: values first, then what to do.
          textOf(column.speed, " m/s exceeds ", column.limit, " m/s: ", flow ? "flow" : "inlet pressure", " at most ",
                 excess->most, flow ? " mL/s" : " mmHg", ", or design_speed_m_per_s of at least ", excess->design_speed)};
}

}  // namespace bleedsim::sph
