// Light on surfaces: ambient, diffuse and specular (Blinn-Phong) in linear colours, and the way from linear to sRGB and back.
#pragma once

#include <Eigen/Core>

#include "service/picture/image.h"

namespace bleedsim::picture {

using LinearColor = Eigen::Array3f;  ///< 0..1 on the screen, brighter while computing

LinearColor toLinear(Color color);
/// Brighter than 1 becomes 1, NaN 0.
Color toSrgb(const LinearColor& color);

/// Directions are view coordinates: x right, y up, z away from the camera.
struct Light {
  Eigen::Vector3f towards{-0.40F, 0.62F, -0.68F};  ///< from the surface to the light, any length above 0
  float ambient = 0.34F;
  float key = 0.80F;  ///< of the directed light
};

struct Material {
  float specular = 0.35F;
  float shininess = 40.0F;  ///< exponent
};

/// What reaches the eye, apart: shadows act on them differently.
struct Lit {
  float ambient = 0.0F;   ///< times the surface's colour
  float diffuse = 0.0F;   ///< times the surface's colour
  float specular = 0.0F;  ///< white
};

/// `normal` and `to_eye` are unit. The diffuse part is greatest where the normal points to the light and 0 where it points away.
Lit lightOn(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye, const Light& light, const Material& material);

/// What a wet surface mirrors: a bright field around the light in a dim room, times Fresnel's share for a liquid.
float mirrored(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye, const Light& light);

}  // namespace bleedsim::picture
