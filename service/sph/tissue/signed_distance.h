// Signed distances to tissue. phi > 0 inside the blood, < 0 inside the tissue; the normal is grad phi, unit, into the blood.
// Every value and normal is finite for finite arguments; where grad phi does not exist (an edge, a medial surface, the centre of
// a sphere) one of its one-sided values is returned. Exact Euclidean distances, so phi is 1-Lipschitz.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

using TissueShape = decltype(TissueDescription::shape);

template <class Real>
struct SignedDistance {
  Real value = 0;                       ///< phi, m
  std::array<Real, 3> normal{0, 0, 1};  ///< unit
  Real curvature = 0;                   ///< 1/R, 1/m: > 0 where blood lies inside a sphere of radius R, 0 on planes and edges
};

template <class Real>
Real vectorLength(Real x, Real y, Real z) {
  return std::sqrt(x * x + y * y + z * z);
}

/// The half space on the side of the normal.
template <class Real>
class PlaneSurface {
 public:
  explicit PlaneSurface(const PlaneShape& shape) {
    const Vec3 unit = shape.normal.normalized();
    for (int axis = 0; axis < 3; ++axis) normal_[axis] = static_cast<Real>(unit[axis]);
    offset_ = static_cast<Real>(unit.dot(shape.point));
  }

  Real value(Real x, Real y, Real z) const { return normal_[0] * x + normal_[1] * y + normal_[2] * z - offset_; }
  /// The least value in the box of these half edges about a point.
  Real leastAbout(const std::array<Real, 3>& center, const std::array<Real, 3>& half) const {
    return value(center[0], center[1], center[2]) -
           (std::abs(normal_[0]) * half[0] + std::abs(normal_[1]) * half[1] + std::abs(normal_[2]) * half[2]);
  }
  const std::array<Real, 3>& normal() const { return normal_; }

 private:
  std::array<Real, 3> normal_{};
  Real offset_ = 0;
};

/// Blood around a block. The distance is to the block itself, so edges and corners are round at phi > 0.
template <class Real>
class ObstacleSurface {
 public:
  explicit ObstacleSurface(const BoxShape& shape) {
    for (int axis = 0; axis < 3; ++axis) {
      lower_[axis] = static_cast<Real>(shape.lower[axis]);
      upper_[axis] = static_cast<Real>(shape.upper[axis]);
    }
  }

  Real lower(int axis) const { return lower_[axis]; }
  Real upper(int axis) const { return upper_[axis]; }

  /// The largest of the distances to the six planes: phi >= this, equal to it beside a face and inside the block.
  Real faceDistance(Real x, Real y, Real z) const { return leastAbout({x, y, z}, {}); }

  /// A bound below faceDistance() in the box of these half edges about a point: it is 1-Lipschitz along each axis.
  Real leastAbout(const std::array<Real, 3>& center, const std::array<Real, 3>& half) const {
    const Real along_x = std::max(lower_[0] - center[0], center[0] - upper_[0]) - half[0];
    const Real along_y = std::max(lower_[1] - center[1], center[1] - upper_[1]) - half[1];
    const Real along_z = std::max(lower_[2] - center[2], center[2] - upper_[2]) - half[2];
    return std::max(along_x, std::max(along_y, along_z));
  }

  SignedDistance<Real> at(Real x, Real y, Real z) const {
    const std::array<Real, 3> point{x, y, z};
    std::array<Real, 3> outside{};  // from the nearest point of the block
    int nearest_axis = 0;
    Real nearest = 0;
    Real nearest_sign = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const Real below = lower_[axis] - point[axis];
      const Real above = point[axis] - upper_[axis];
      outside[axis] = std::max(above, Real{0}) - std::max(below, Real{0});
      const Real face = std::max(below, above);
      if (axis > 0 && !(face > nearest)) continue;
      nearest = face;
      nearest_axis = axis;
      nearest_sign = above >= below ? Real{1} : Real{-1};
    }
    SignedDistance<Real> result;
    const Real length = vectorLength(outside[0], outside[1], outside[2]);
    if (length > 0) {
      result.value = length;
      for (int axis = 0; axis < 3; ++axis) result.normal[axis] = outside[axis] / length;
    } else {
      result.value = nearest;
      result.normal = {0, 0, 0};
      result.normal[nearest_axis] = nearest_sign;
    }
    return result;
  }

 private:
  std::array<Real, 3> lower_{};
  std::array<Real, 3> upper_{};
};

/// The tissue is {z <= rim} without a ball; its edge is the rim circle, convex. Inside the tissue the blood (the union of the
/// half space above the rim and the ball) is as far as the nearer of the two. In the blood the nearest point of the tissue is on
/// the plane outside the rim circle, on the sphere for points that project radially below the rim, and else on the rim circle.
template <class Real>
class BowlSurface {
 public:
  explicit BowlSurface(const BowlShape& shape) {
    const double height = shape.sphere_radius - shape.depth;
    for (int axis = 0; axis < 3; ++axis) center_[axis] = static_cast<Real>(shape.rim_center[axis]);
    center_[2] = static_cast<Real>(shape.rim_center[2] + height);
    rim_ = static_cast<Real>(shape.rim_center[2]);
    height_ = static_cast<Real>(height);
    radius_ = static_cast<Real>(shape.sphere_radius);
    rim_radius_ = static_cast<Real>(std::sqrt(std::max(0.0, shape.sphere_radius * shape.sphere_radius - height * height)));
  }

  /// The plane and the sphere seen apart: the tissue is the intersection of what lies behind the one and outside the other.
  struct Parts {
    Real plane = 0;                              ///< z - rim, m
    Real sphere = 0;                             ///< R - distance from the centre, m
    std::array<Real, 3> sphere_normal{0, 0, 1};  ///< towards the centre
    Real center_distance = 0;                    ///< m
  };

  /// Whether the box of these half edges about a point comes nearer than `reach` to the plane and to the sphere; false for what
  /// is no number.
  bool nears(const std::array<Real, 3>& center, const std::array<Real, 3>& half, Real reach) const {
    return center[2] - half[2] - rim_ < reach && nearsSphere(center, half, reach);
  }

  /// The same of the sphere alone.
  bool nearsSphere(const std::array<Real, 3>& center, const std::array<Real, 3>& half, Real reach) const {
    const Real dx = std::abs(center_[0] - center[0]) + half[0];
    const Real dy = std::abs(center_[1] - center[1]) + half[1];
    const Real dz = std::abs(center_[2] - center[2]) + half[2];
    const Real inside = radius_ - reach;  // so far from the centre nothing is near
    const Real square = dx * dx + dy * dy + dz * dz;
    return inside < Real(0) ? square >= Real(0) : square > inside * inside;
  }

  /// Whether points of this height, and all below, are so deep under the rim that within `reach` only the sphere is felt.
  bool isHollow(Real z, Real reach) const { return z - rim_ <= -reach; }

  Parts parts(Real x, Real y, Real z) const {
    const Real dx = center_[0] - x;
    const Real dy = center_[1] - y;
    const Real dz = center_[2] - z;
    Parts result;
    result.plane = z - rim_;
    result.center_distance = vectorLength(dx, dy, dz);
    result.sphere = radius_ - result.center_distance;
    if (result.center_distance > 0) {
      result.sphere_normal = {dx / result.center_distance, dy / result.center_distance, dz / result.center_distance};
    }
    return result;
  }

  SignedDistance<Real> at(Real x, Real y, Real z) const { return at(x, y, z, parts(x, y, z)); }

  SignedDistance<Real> at(Real x, Real y, Real z, const Parts& part) const {
    if (part.plane <= 0 && part.sphere <= 0) {  // inside the tissue
      return part.plane >= part.sphere ? ofPlane(part) : ofSphere(part);
    }
    const Real dx = x - center_[0];
    const Real dy = y - center_[1];
    const Real radial = std::sqrt(dx * dx + dy * dy);
    if (part.plane >= 0 && radial >= rim_radius_) return ofPlane(part);
    const Real below_center = center_[2] - z;
    if (below_center >= 0 && radial * height_ <= rim_radius_ * below_center) return ofSphere(part);
    const Real inwards = rim_radius_ - radial;
    const Real length = std::sqrt(inwards * inwards + part.plane * part.plane);
    SignedDistance<Real> result;
    result.value = length;
    if (length > 0 && radial > 0) {
      result.normal = {-dx / radial * (inwards / length), -dy / radial * (inwards / length), part.plane / length};
    }
    return result;
  }

 private:
  SignedDistance<Real> ofPlane(const Parts& part) const { return {.value = part.plane}; }
  SignedDistance<Real> ofSphere(const Parts& part) const {
    return {.value = part.sphere, .normal = part.sphere_normal, .curvature = Real{1} / radius_};
  }

  std::array<Real, 3> center_{};
  Real rim_ = 0;
  Real height_ = 0;  ///< of the centre above the rim
  Real radius_ = 0;
  Real rim_radius_ = 0;
};

/// phi of any shape in double precision. A container's tissue is everything outside its box; with an open top its four side walls
/// go on upwards without end.
SignedDistance<double> signedDistance(const TissueShape& shape, const Vec3& point);

/// The faces of a container as planes into the blood, the upper z face last and left out if the top is open.
std::vector<PlaneShape> containerFaces(const BoxShape& box);

}  // namespace bleedsim::sph
