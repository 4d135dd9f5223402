#include "service/picture/smooth_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bleedsim::picture {
namespace {

constexpr double kWidestSigma = 24.0;  // pixels: bounds the time of a close-up

/// Weights of a Gauss bell for offsets 0, 1, ... pixels.
std::vector<float> bell(double sigma_px) {
  const double sigma = std::clamp(sigma_px, 0.5, kWidestSigma);
  std::vector<float> weights(static_cast<std::size_t>(std::ceil(2.0 * sigma)) + 1);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    weights[k] = static_cast<float>(std::exp(-0.5 * static_cast<double>(k * k) / (sigma * sigma)));
  }
  return weights;
}

double meanDepth(const Surface& surface) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const float depth : surface.depth) {
    if (!(depth < kNoDepth)) continue;
    sum += static_cast<double>(depth);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

/// A line of the picture: `count` pixels from `first`, `stride` apart.
struct Line {
  std::size_t first;
  std::size_t stride;
  int count;
};

/// Depths nearer than the range belong to something in front, and their mirror image is left out as well, so that no edge is
/// pulled; deeper ones count as lying just at the end of the range.
float filteredDepth(const std::vector<float>& depth, const Line& line, int at, const std::vector<float>& weights, float range) {
  const float middle = depth[line.first + static_cast<std::size_t>(at) * line.stride];
  float sum = middle * weights[0];
  float weight = weights[0];
  for (int k = 1; k < static_cast<int>(weights.size()); ++k) {
    if (at - k < 0 || at + k >= line.count) break;
    const float before = depth[line.first + static_cast<std::size_t>(at - k) * line.stride];
    const float after = depth[line.first + static_cast<std::size_t>(at + k) * line.stride];
    if (before < middle - range || after < middle - range || before == kNoDepth || after == kNoDepth) continue;
    const float w = weights[static_cast<std::size_t>(k)];
    sum += w * (std::min(before, middle + range) + std::min(after, middle + range));
    weight += 2.0F * w;
  }
  return sum / weight;
}

template <class Filter>
void overLines(const Surface& surface, bool rows, const std::vector<float>& from, std::vector<float>& to, const Filter& filter) {
  const auto width = static_cast<std::size_t>(surface.width);
  for (int y = 0; y < surface.height; ++y) {
    for (int x = 0; x < surface.width; ++x) {
      const std::size_t i = surface.index(x, y);
      if (!surface.has(i)) continue;
      const Line line =
          rows ? Line{surface.index(0, y), 1, surface.width} : Line{static_cast<std::size_t>(x), width, surface.height};
      to[i] = filter(from, line, rows ? x : y);
    }
  }
}

/// The difference to the neighbour on the smoother side, as a vector; zero when there is none.
Vec3 slope(const View& view, const Surface& surface, int x, int y, int dx, int dy) {
  const auto point = [&](int px, int py) {
    return view.fromPixel(px + 0.5, py + 0.5, static_cast<double>(surface.depth[surface.index(px, py)]));
  };
  const auto known = [&](int px, int py) {
    return px >= 0 && py >= 0 && px < surface.width && py < surface.height && surface.has(surface.index(px, py));
  };
  const Vec3 here = point(x, y);
  const bool after = known(x + dx, y + dy);
  const bool before = known(x - dx, y - dy);
  if (after && before) {
    const Vec3 forward = point(x + dx, y + dy) - here;
    const Vec3 backward = here - point(x - dx, y - dy);
    const double small = std::min(std::abs(forward.z()), std::abs(backward.z()));
    // Central differences where the surface is smooth, the flatter side at a step.
    if (std::max(std::abs(forward.z()), std::abs(backward.z())) < 3.0 * small + 1e-9) return 0.5 * (forward + backward);
    return std::abs(forward.z()) < std::abs(backward.z()) ? forward : backward;
  }
  if (after) return point(x + dx, y + dy) - here;
  if (before) return here - point(x - dx, y - dy);
  return Vec3::Zero();
}

void takeNormals(const View& view, Surface& surface) {
  for (int y = 0; y < surface.height; ++y) {
    for (int x = 0; x < surface.width; ++x) {
      const std::size_t i = surface.index(x, y);
      if (!surface.has(i)) continue;
      const Vec3 right = slope(view, surface, x, y, 1, 0);
      const Vec3 down = slope(view, surface, x, y, 0, 1);
      Vec3 normal = down.cross(right);
      if (!(normal.norm() > 0.0)) continue;  // alone in its row or column: the sphere's own normal stays
      if (normal.dot(view.fromPixel(x + 0.5, y + 0.5, 1.0) -
                     (view.perspective() ? Vec3{0, 0, 0} : view.fromPixel(x + 0.5, y + 0.5, 0.0))) > 0.0) {
        normal = -normal;
      }
      surface.normal[i] = normal.normalized().cast<float>();
    }
  }
}

}  // namespace

void smoothSurface(const View& view, const SmoothSettings& settings, Surface& surface) {
  const std::vector<float> weights = bell(settings.sigma_m * view.pixelsPerMetre(meanDepth(surface)));
  const auto range = static_cast<float>(settings.range_m);
  const auto filter = [&](const std::vector<float>& depth, const Line& line, int at) {
    return filteredDepth(depth, line, at, weights, range);
  };
  std::vector<float> other = surface.depth;
  for (int i = 0; i < settings.iterations; ++i) {
    overLines(surface, true, surface.depth, other, filter);
    overLines(surface, false, other, surface.depth, filter);
  }
  takeNormals(view, surface);
}

void smoothQuantity(const View& view, double sigma_m, const Surface& surface, std::vector<float>& quantity) {
  const std::vector<float> weights = bell(sigma_m * view.pixelsPerMetre(meanDepth(surface)));
  const auto filter = [&](const std::vector<float>& values, const Line& line, int at) {
    const float middle = values[line.first + static_cast<std::size_t>(at) * line.stride];
    if (std::isnan(middle)) return middle;
    float sum = middle * weights[0];
    float weight = weights[0];
    const int reach = static_cast<int>(weights.size()) - 1;
    for (int k = std::max(-reach, -at); k <= std::min(reach, line.count - 1 - at); ++k) {
      const std::size_t i = line.first + static_cast<std::size_t>(at + k) * line.stride;
      if (k == 0 || !surface.has(i) || std::isnan(values[i])) continue;
      sum += weights[static_cast<std::size_t>(std::abs(k))] * values[i];
      weight += weights[static_cast<std::size_t>(std::abs(k))];
    }
    return sum / weight;
  };
  std::vector<float> other = quantity;
  overLines(surface, true, quantity, other, filter);
  overLines(surface, false, other, quantity, filter);
}

}  // namespace bleedsim::picture
