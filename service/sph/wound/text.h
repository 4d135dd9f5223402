// Messages of refused wounds: values are printed so that they can be typed back.
#pragma once

#include <sstream>
#include <string>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// The parts one after the other; numbers with six significant digits.
template <class... Parts>
std::string textOf(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

/// "(x, y, z)"
inline std::string textOfPoint(const Vec3& p) { return textOf("(", p.x(), ", ", p.y(), ", ", p.z(), ")"); }
inline std::string textOfPoint(const Vec2& p) { return textOf("(", p.x(), ", ", p.y(), ")"); }

}  // namespace bleedsim::sph
