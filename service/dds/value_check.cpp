#include "service/dds/value_check.h"

#include <cmath>
#include <fmt/core.h>

#include "service/status/printable_text.h"

namespace bleedsim::dds {

Status checkNumber(std::string_view field, double value, const Limits& limits) {
  if (!std::isfinite(value)) {
    return {StatusCode::invalid_argument,
            fmt::format("{} is {}: use a finite number, {:g} to {:g} {}", field, value, limits.lower, limits.upper, limits.unit)};
  }
  if (value >= limits.lower && value <= limits.upper) return {};
  return {StatusCode::invalid_argument,
          fmt::format("{} is {:g}: use {:g} to {:g} {}", field, value, limits.lower, limits.upper, limits.unit)};
}

Result<sph::Vec3> checkVector(std::string_view field, const bleed_v1_Vec3& value, const Limits& limits) {
  const double components[] = {value.x, value.y, value.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (Status checked = checkNumber(fmt::format("{}.{}", field, "xyz"[axis]), components[axis], limits); !checked)
      return checked;
  }
  return sph::Vec3{value.x, value.y, value.z};
}

Result<sph::Vec3> checkDirection(std::string_view field, const bleed_v1_Vec3& value) {
  Result<sph::Vec3> vector = checkVector(field, value, kPositionLimits);
  if (!vector) return vector;
  const double length = vector->norm();
  if (!(length >= kDirectionLengthLimits.lower && length <= kDirectionLengthLimits.upper)) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("{} has length {:g}: use a direction of any length from {:g} to {:g}", field, length,
                              kDirectionLengthLimits.lower, kDirectionLengthLimits.upper)};
  }
  return sph::Vec3{*vector / length};
}

Status checkLabel(std::string_view field, std::string_view text) {
  const Status printable = checkPrintable(text);
  if (printable) return {};
  return {StatusCode::invalid_argument, fmt::format("{}: {}", field, printable.message())};
}

}  // namespace bleedsim::dds
