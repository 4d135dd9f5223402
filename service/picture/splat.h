// Particles as spheres in a depth buffer: every pixel meets the exact surface of its nearest sphere.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "service/picture/camera.h"
#include "service/status/status.h"

namespace bleedsim::picture {

/// Views of the caller's arrays. A particle with a position or radius that is not finite, or a radius of 0 or less, is skipped.
struct ParticleCloud {
  std::span<const float> positions{};  ///< 3 x count, m
  double radius_m = 0.0;               ///< of all particles, unless `radii` is given
  std::span<const float> radii{};      ///< count, m, or empty
  std::span<const float> values{};     ///< count: what the particles are coloured by; or empty: blood

  std::size_t count() const { return positions.size() / 3; }
};

/// invalid_argument: the arrays do not have the same count, or there is no radius.
Status checkCloud(const ParticleCloud& cloud);

constexpr float kNoDepth = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kNoParticle = std::numeric_limits<std::uint32_t>::max();

/// What a camera sees, pixel by pixel, rows from the top. Normals are unit, in view coordinates (x right, y up, z away).
struct Surface {
  Surface(int w, int h)
      : width{w}, height{h}, depth(std::size_t(w) * std::size_t(h), kNoDepth), normal(depth.size(), Eigen::Vector3f::Zero()) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  bool has(std::size_t i) const { return depth[i] < kNoDepth; }

  int width;
  int height;
  std::vector<float> depth;  ///< m along the line of sight, kNoDepth: nothing there
  std::vector<Eigen::Vector3f> normal;
};

struct SplatCounts {
  std::size_t drawn = 0;       ///< at least partly inside the picture; may still be hidden by others
  std::size_t not_finite = 0;  ///< skipped for a bad position or radius
  std::size_t outside = 0;     ///< not wholly in front of the camera, or beside the picture
};

struct Splats {
  Surface surface;
  std::vector<std::uint32_t> particle;  ///< the nearest, or kNoParticle
  std::vector<float> thickness;         ///< of all spheres along the ray, m; only when asked for
  std::vector<float> value;             ///< mean of the finite values by thickness; only when asked for and given
  SplatCounts counts;
};

struct SplatSettings {
  double radius_factor = 1.0;
  bool thickness = false;
};

/// Where two spheres are equally near, the particle of the lower index is seen. The cloud must have passed checkCloud.
Splats splatSpheres(const View& view, const ParticleCloud& cloud, const SplatSettings& settings);

}  // namespace bleedsim::picture
