// Numbers as colours: dark blue over green to yellow, of rising lightness, so that it reads in grey and to the colour-blind.
#pragma once

#include <optional>
#include <span>

#include "service/picture/image.h"

namespace bleedsim::picture {

/// 0 is the darkest colour, 1 the lightest; beyond them the nearest one. NaN is grey.
Color mapColor(double value);

/// What NaN values are drawn in.
constexpr Color kNotANumberColor{150, 150, 150};

struct Range {
  double lower = 0.0;
  double upper = 1.0;

  /// 0 at lower, 1 at upper.
  double share(double value) const { return (value - lower) / (upper - lower); }
};

/// From the least to the greatest finite value. Where all are equal the range is widened, so that upper > lower always; nothing
/// when no value is finite.
std::optional<Range> rangeOf(std::span<const float> values);

}  // namespace bleedsim::picture
