#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <string>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

using Points = google::protobuf::RepeatedPtrField<Vec2>;

void validatePoints(const std::string& path, const Points& points, std::size_t fewest, ProblemList& problems) {
  const auto size = static_cast<std::size_t>(points.size());
  if (size < fewest || size > kMaxPatchPoints) {
    problems.add(path, fmt::format("{} points are given, allowed {} to {}", size, fewest, kMaxPatchPoints));
  }
  for (int i = 0; i < std::min(points.size(), static_cast<int>(kMaxPatchPoints)); ++i) {
    problems.requireInRange(fmt::format("{}[{}].u", path, i), points[i].u(), kPatchCoordinate);
    problems.requireInRange(fmt::format("{}[{}].v", path, i), points[i].v(), kPatchCoordinate);
  }
}

void validateShape(const std::string& path, const Wound& wound, ProblemList& problems) {
  switch (wound.shape_case()) {
    case Wound::kDisc:
      problems.requireInRange(path + ".disc.radius_m", wound.disc().radius_m(), kPatchLength);
      return;
    case Wound::kEllipse:
      problems.requireInRange(path + ".ellipse.semi_axis_u_m", wound.ellipse().semi_axis_u_m(), kPatchLength);
      problems.requireInRange(path + ".ellipse.semi_axis_v_m", wound.ellipse().semi_axis_v_m(), kPatchLength);
      return;
    case Wound::kPolygon:
      validatePoints(path + ".polygon.points_m", wound.polygon().points_m(), kMinPolygonPoints, problems);
      return;
    case Wound::kPolyline:
      problems.requireInRange(path + ".polyline.width_m", wound.polyline().width_m(), kPatchLength);
      validatePoints(path + ".polyline.points_m", wound.polyline().points_m(), kMinPolylinePoints, problems);
      return;
    case Wound::SHAPE_NOT_SET:
      problems.add(path, "has no shape; give one of disc, ellipse, polygon, polyline");
      return;
  }
}

void validateDrive(const std::string& path, const Wound& wound, ProblemList& problems) {
  switch (wound.drive_case()) {
    case Wound::kFlowMlPerS:
      problems.requireInRange(path + ".flow_ml_per_s", wound.flow_ml_per_s(), kFlow);
      return;
    case Wound::kPressure:
      problems.requireInRange(path + ".pressure.inlet_pressure_mmhg", wound.pressure().inlet_pressure_mmhg(), kInletPressure);
      problems.requireInRange(path + ".pressure.discharge_coefficient", wound.pressure().discharge_coefficient(),
                              kDischargeCoefficient);
      return;
    case Wound::DRIVE_NOT_SET:
      problems.add(path, "has no drive; give one of flow_ml_per_s, pressure");
      return;
  }
}

void requireInside(const std::string& path, const Vec3& point, const Domain& domain, ProblemList& problems) {
  const auto require = [&](char axis, double value, double lower, double upper) {
    // A domain that is upside down has its own problem.
    if (lower < upper && (value < lower || value > upper)) {
      problems.add(fmt::format("{}.{}", path, axis),
                   fmt::format("value {} is outside the domain, allowed {} to {} (m)", value, lower, upper));
    }
  };
  require('x', point.x(), domain.lower_m().x(), domain.upper_m().x());
  require('y', point.y(), domain.lower_m().y(), domain.upper_m().y());
  require('z', point.z(), domain.lower_m().z(), domain.upper_m().z());
}

void validateWound(const std::string& path, const Wound& wound, const Domain& domain, ProblemList& problems) {
  const std::size_t before = problems.count();
  requirePoint(path + ".position_m", wound.position_m(), problems);
  if (problems.count() == before) requireInside(path + ".position_m", wound.position_m(), domain, problems);
  requireDirection(path + ".normal", wound.normal(), problems);
  if (wound.has_tangent()) requireDirection(path + ".tangent", wound.tangent(), problems);
  validateShape(path, wound, problems);
  validateDrive(path, wound, problems);
}

}  // namespace

void validateWounds(const Scene& scene, ProblemList& problems) {
  const int count = requireCount("wounds", scene.wounds_size(), kMaxSceneWounds, problems, "open further ones by command");
  if (static_cast<std::uint32_t>(scene.wounds_size()) > scene.commands().max_wounds()) {
    problems.add("wounds", fmt::format("{} are given, but commands.max_wounds is {}; raise it", scene.wounds_size(),
                                       scene.commands().max_wounds()));
  }
  std::map<std::string, int> first_of_name;
  for (int i = 0; i < count; ++i) {
    const Wound& wound = scene.wounds(i);
    const std::string path = fmt::format("wounds[{}]", i);
    validateWound(path, wound, scene.domain(), problems);
    if (!requireName(path + ".name", wound.name(), problems) || wound.name().empty()) continue;
    const auto [first, is_new] = first_of_name.emplace(wound.name(), i);
    if (!is_new) {
      problems.add(path + ".name", fmt::format("'{}' is already the name of wounds[{}]; give each wound its own or none",
                                               wound.name(), first->second));
    }
  }
}

}  // namespace bleedsim::scene
