#include "service/picture/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bleedsim::picture {
namespace {

// Anchors at equal distances; their luminance rises by about the same step from one to the next.
constexpr std::array<std::array<double, 3>, 8> kAnchors{{
    {66, 8, 86},
    {72, 47, 124},
    {57, 86, 140},
    {40, 120, 142},
    {30, 155, 137},
    {78, 190, 106},
    {165, 218, 56},
    {252, 230, 40},
}};

}  // namespace

Color mapColor(double value) {
  if (std::isnan(value)) return kNotANumberColor;
  const double at = std::clamp(value, 0.0, 1.0) * (kAnchors.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), kAnchors.size() - 2);
  const double part = at - static_cast<double>(low);
  const auto channel = [&](std::size_t c) {
    return static_cast<std::uint8_t>(std::lround(kAnchors[low][c] + part * (kAnchors[low + 1][c] - kAnchors[low][c])));
  };
  return {channel(0), channel(1), channel(2)};
}

std::optional<Range> rangeOf(std::span<const float> values) {
  std::optional<Range> range;
  for (const float value : values) {
    if (!std::isfinite(value)) continue;
    const double v = static_cast<double>(value);
    if (!range) range = Range{v, v};
    range->lower = std::min(range->lower, v);
    range->upper = std::max(range->upper, v);
  }
  if (range && !(range->upper > range->lower)) {
    const double widen = std::max(1e-6 * std::abs(range->lower), 1e-12);
    range->lower -= widen;
    range->upper += widen;
  }
  return range;
}

}  // namespace bleedsim::picture
