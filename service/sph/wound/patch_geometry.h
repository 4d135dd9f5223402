// The shape of a wound's opening: its checks, measures and frame. Lengths in m, areas in m^2.
#pragma once

#include <cstddef>

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

inline constexpr double kMinPointDistance = 1e-7;  ///< m, of consecutive points

/// invalid_argument naming the value and the allowed range: every number finite and within kPatchLength or kPatchCoordinate, a
/// polygon of 3..256 points that encloses an area and does not touch itself, a polyline of 2..256 points, no two consecutive ones
/// equal.
Status checkPatch(const PatchShape& shape);

/// m^2. Of a polyline length x width plus the two half discs at its ends; where it bends or crosses itself sharply the overlap
/// counts twice, which only makes its column slower than flow / true area would be. The shape must have passed checkPatch.
double patchArea(const PatchShape& shape);

/// Radius of the circle about the patch's origin that holds the outline, m.
double boundingRadius(const PatchShape& shape);

/// Length of the line along the points, m.
double polylineLength(const PolylinePatch& shape);

/// A right-handed orthonormal frame: u x v = normal.
struct PatchFrame {
  Vec3 origin = Vec3::Zero();
  Vec3 normal{0.0, 0.0, 1.0};
  Vec3 u{1.0, 0.0, 0.0};
  Vec3 v{0.0, 1.0, 0.0};

  Vec3 toWorld(const Vec2& lateral, double height) const { return origin + lateral.x() * u + lateral.y() * v + height * normal; }
  /// (u, v, height) of an offset from the origin.
  Vec3 toLocal(const Vec3& offset) const { return {offset.dot(u), offset.dot(v), offset.dot(normal)}; }
};

/// The normal is normalised. u is the tangent's part in the patch's plane; where the tangent is zero or parallel to the normal, u
/// is chosen from the coordinate axis that is furthest from the normal. invalid_argument if a number is not finite or the
/// normal is zero.
Result<PatchFrame> makePatchFrame(const Vec3& origin, const Vec3& normal, const Vec3& tangent);

}  // namespace bleedsim::sph
