#include "service/picture/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bleedsim::picture {
namespace {

struct Offset {
  int x;
  int y;
};

constexpr std::size_t kPairs = 8;
constexpr float kFarLengths = 6.0F;

/// Half of the neighbours; the other half lies opposite. Distances grow with the index, angles turn by the golden angle.
std::array<Offset, kPairs> offsetsFor(double reach_px) {
  std::array<Offset, kPairs> offsets{};
  for (std::size_t k = 0; k < kPairs; ++k) {
    const double distance = reach_px * std::sqrt((static_cast<double>(k) + 0.7) / kPairs);
    const double angle = static_cast<double>(k) * 2.0 * std::numbers::pi * (2.0 - std::numbers::phi);
    offsets[k] = {static_cast<int>(std::lround(distance * std::cos(angle))),
                  static_cast<int>(std::lround(distance * std::sin(angle)))};
  }
  return offsets;
}

}  // namespace

std::vector<float> occlusionOf(const std::vector<float>& depth, int width, int height, double length_m, double reach_px) {
  std::vector<float> occlusion(depth.size(), 0.0F);
  const std::array<Offset, kPairs> offsets = offsetsFor(std::clamp(reach_px, 1.0, 60.0));
  const auto per_length = static_cast<float>(1.0 / length_m);
  const auto index = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float here = depth[index(x, y)];
      if (here == kNoDepth) continue;
      float sum = 0.0F;
      for (const Offset& offset : offsets) {
        const auto nearer_by = [&](int px, int py) {
          const float there = depth[index(std::clamp(px, 0, width - 1), std::clamp(py, 0, height - 1))];
          const float lengths = (here - there) * per_length;
          // Beyond the far bound it fades to nothing; what is missing or much deeper is as if on the same level.
          if (lengths > kFarLengths) return std::max(0.0F, 2.0F * kFarLengths - lengths);
          return std::max(lengths, -kFarLengths);
        };
        sum += std::clamp(0.5F * (nearer_by(x + offset.x, y + offset.y) + nearer_by(x - offset.x, y - offset.y)), 0.0F, 1.0F);
      }
      occlusion[index(x, y)] = sum / kPairs;
    }
  }
  return occlusion;
}

}  // namespace bleedsim::picture
