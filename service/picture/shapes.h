// Tissue as analytic shapes, met by rays. The fields are those of a scene's tissue. World coordinates, m.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "service/picture/camera.h"

namespace bleedsim::picture {

/// Seen from its front only: a camera behind it looks through.
struct PlaneShape {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();                                   ///< into the blood, any length
  double half_size_m = std::numeric_limits<double>::infinity();  ///< of the square that is drawn around `point`
};

/// A container is cut open: only those inner faces are drawn that the camera sees from inside.
struct BoxShape {
  Vec3 lower = Vec3::Zero();
  Vec3 upper = Vec3::Zero();
  bool container = false;  ///< blood inside the box, or around it
  bool open_top = false;   ///< a container without its upper z face
};

/// A plane that faces +z with a spherical hollow pressed into it.
struct BowlShape {
  Vec3 rim_center = Vec3::Zero();  ///< centre of the rim circle, in the plane
  double sphere_radius_m = 0.0;
  double depth_m = 0.0;  ///< of the lowest point below the rim, in (0, sphere_radius_m]
};

using Shape = std::variant<PlaneShape, BoxShape, BowlShape>;

/// invalid_argument: numbers that are not finite or make no shape; the message names the field.
Status checkShape(const Shape& shape);

struct ShapeHit {
  double depth = 0.0;           ///< of the ray
  Vec3 normal = Vec3::UnitZ();  ///< unit, towards the camera's side
  Eigen::Vector2d mark{0, 0};   ///< coordinates in the surface for a grid, m
};

/// The first hit at a depth above 0. The shape must have passed checkShape.
std::optional<ShapeHit> hitShape(const Shape& shape, const Ray& ray);
/// Whether the ray runs inside the tissue of a plane or bowl and parallel to its surface: a view from exactly the side shows a
/// cut through it.
bool cutsThrough(std::span<const Shape> shapes, const Ray& ray);
/// The nearest hit of all.
std::optional<ShapeHit> hitShapes(std::span<const Shape> shapes, const Ray& ray);

}  // namespace bleedsim::picture
