#include "service/scene/validate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "service/scene/fill_defaults.h"
#include "service/scene/number_walk.h"

namespace bleedsim::scene {
namespace {

struct Coordinate {
  char name;
  double value;
};

std::array<Coordinate, 3> coordinates(const Vec3& v) { return {{{'x', v.x()}, {'y', v.y()}, {'z', v.z()}}}; }

}  // namespace

void requirePoint(std::string_view path, const Vec3& point, ProblemList& problems) {
  for (const auto& [name, value] : coordinates(point)) {
    problems.requireInRange(fmt::format("{}.{}", path, name), value, kCoordinate);
  }
}

void requireDirection(std::string_view path, const Vec3& direction, ProblemList& problems) {
  const double length = std::hypot(direction.x(), direction.y(), direction.z());
  if (!std::isfinite(direction.x()) || !std::isfinite(direction.y()) || !std::isfinite(direction.z())) return;
  if (length >= kDirection.lower && length <= kDirection.upper) return;
  problems.add(path, fmt::format("direction ({}, {}, {}) has length {}, allowed {} to {}; give a vector that is not zero, "
                                 "it is normalised",
                                 direction.x(), direction.y(), direction.z(), length, kDirection.lower, kDirection.upper));
}

bool requireBox(std::string_view path, bool has_lower, const Vec3& lower, bool has_upper, const Vec3& upper,
                ProblemList& problems) {
  const std::size_t before = problems.count();
  if (!has_lower) problems.add(fmt::format("{}.lower_m", path), "is required: the corner with the smallest coordinates (m)");
  if (!has_upper) problems.add(fmt::format("{}.upper_m", path), "is required: the corner with the largest coordinates (m)");
  if (!has_lower || !has_upper) return false;
  requirePoint(fmt::format("{}.lower_m", path), lower, problems);
  requirePoint(fmt::format("{}.upper_m", path), upper, problems);
  bool finite = true;
  const std::array<Coordinate, 3> low = coordinates(lower);
  const std::array<Coordinate, 3> high = coordinates(upper);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(low[axis].value) || !std::isfinite(high[axis].value)) {
      finite = false;
    } else if (high[axis].value <= low[axis].value) {
      problems.add(fmt::format("{}.upper_m.{}", path, high[axis].name),
                   fmt::format("value {} must be above lower_m.{}, {} (m)", high[axis].value, low[axis].name, low[axis].value));
    }
  }
  return finite && problems.count() == before;
}

int requireCount(std::string_view path, int count, int most, ProblemList& problems, std::string_view remedy) {
  if (count > most) problems.add(path, fmt::format("{} are given, allowed are at most {}; {}", count, most, remedy));
  return std::min(count, most);
}

void validate(const Scene& scene, ProblemList& problems) {
  reportNonFinite(scene, problems);
  validateText(scene, problems);
  validateDomain(scene, problems);
  Scene complete = scene;
  fillEffects(*complete.mutable_effects());  // what the literal model does not read has no default in the text
  validateEffects(complete, problems);
  validateCombinations(complete, problems);
  validateLiteralModel(scene, problems);
  validateOutput(scene, problems);
  validateTissue(scene, problems);
  validateWounds(scene, problems);
  validateFluidBlocks(scene, problems);
}

}  // namespace bleedsim::scene
