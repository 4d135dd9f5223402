#include "service/dds/value_check.h"

#include <cmath>
#include <fmt/core.h>

#include "service/status/printable_text.h"

namespace bleedsim::dds {

namespace {

/// "0 to 1000 mL/s"
std::string textOf(const Range& range) {
  return fmt::format("{:g} to {:g}{}{}", range.lower, range.upper, range.unit.empty() ? "" : " ", range.unit);
}

}  // namespace

Status checkNumber(std::string_view field, double value, const Range& range) {
  if (!std::isfinite(value)) {
    return {StatusCode::invalid_argument, fmt::format("{} is {}: use a finite number, {}", field, value, textOf(range))};
  }
  if (value >= range.lower && value <= range.upper) return {};
  return {StatusCode::invalid_argument, fmt::format("{} is {:g}: use {}", field, value, textOf(range))};
}

Result<sph::Vec3> checkVector(std::string_view field, const bleed_v1_Vec3& value, const Range& range) {
  const double components[] = {value.x, value.y, value.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (Status checked = checkNumber(fmt::format("{}.{}", field, "xyz"[axis]), components[axis], range); !checked) return checked;
  }
  return sph::Vec3{value.x, value.y, value.z};
}

Result<sph::Vec3> checkLength(std::string_view field, const bleed_v1_Vec3& value, const Range& range) {
  Result<sph::Vec3> vector = checkVector(field, value, {-range.upper, range.upper, range.unit});
  if (!vector) return vector;
  if (Status length = checkNumber(field, vector->norm(), range); !length) return length;
  return vector;
}

Result<sph::Vec3> checkDirection(std::string_view field, const bleed_v1_Vec3& value) {
  Result<sph::Vec3> vector = checkVector(field, value, kComponent);
  if (!vector) return vector;
  const double length = vector->norm();
  if (!(length >= kDirection.lower && length <= kDirection.upper)) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("{} has length {:g}: use a direction of any length from {}", field, length, textOf(kDirection))};
  }
  return sph::Vec3{*vector / length};
}

Status checkLabel(std::string_view field, std::string_view text) {
  const Status printable = checkPrintable(text);
  if (printable) return {};
  return {StatusCode::invalid_argument, fmt::format("{}: {}", field, printable.message())};
}

}  // namespace bleedsim::dds
