#include "service/sph/tissue/signed_distance.h"

namespace bleedsim::sph {
namespace {

SignedDistance<double> containerDistance(const BoxShape& box, const Vec3& point) {
  SignedDistance<double> result{.value = std::numeric_limits<double>::infinity()};
  Vec3 inwards = Vec3::Zero();  // from a point in the tissue to the nearest point of the box
  for (const PlaneShape& face : containerFaces(box)) {
    const double distance = face.normal.dot(point - face.point);
    if (distance < 0.0) inwards -= distance * face.normal;
    if (distance >= result.value) continue;
    result.value = distance;
    result.normal = {face.normal.x(), face.normal.y(), face.normal.z()};
  }
  const double depth = inwards.norm();
  if (depth > 0.0) {
    result.value = -depth;
    result.normal = {inwards.x() / depth, inwards.y() / depth, inwards.z() / depth};
  }
  return result;
}

}  // namespace

std::vector<PlaneShape> containerFaces(const BoxShape& box) {
  std::vector<PlaneShape> faces;
  for (int axis = 0; axis < 3; ++axis) {
    faces.push_back({.point = box.lower, .normal = Vec3::Unit(axis)});
    if (axis == 2 && box.open_top) continue;
    faces.push_back({.point = box.upper, .normal = -Vec3::Unit(axis)});
  }
  return faces;
}

SignedDistance<double> signedDistance(const TissueShape& shape, const Vec3& point) {
  const double x = point.x();
  const double y = point.y();
  const double z = point.z();
  if (const auto* plane = std::get_if<PlaneShape>(&shape)) {
    const PlaneSurface<double> surface{*plane};
    return {.value = surface.value(x, y, z), .normal = surface.normal()};
  }
  if (const auto* bowl = std::get_if<BowlShape>(&shape)) return BowlSurface<double>{*bowl}.at(x, y, z);
  const BoxShape& box = std::get<BoxShape>(shape);
  return box.obstacle ? ObstacleSurface<double>{box}.at(x, y, z) : containerDistance(box, point);
}

}  // namespace bleedsim::sph
