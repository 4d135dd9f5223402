// The text of a small scene: tissue in the plane z = 0, blood that a wound or a block brings.
#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>

namespace bleedsim::test {

inline constexpr const char* kCut = "wounds { name: 'cut' disc { radius_m: 0.003 } flow_ml_per_s: 1.5 }\n";

/// c0 is 3 m/s. As it stands, two full frames are 112 kB: they fit the receive buffer of a plain kernel.
struct FlatScene {
  double half_side = 0.03;        ///< m, of the domain about the origin
  double height = 0.03;           ///< m above the tissue, 12 mm are below
  std::uint32_t capacity = 2000;  ///< particles
  double spacing = 0.003;         ///< m
  std::string effects = "gravity {} pressure {} viscosity {}";
  std::string more{};  ///< further messages, as kCut

  std::string text() const {
    return fmt::format(
        "domain {{ lower_m {{ x: -{0} y: -{0} z: -0.012 }} upper_m {{ x: {0} y: {0} z: {1} }} capacity: {2} }}\n"
        "resolution {{ spacing_m: {3} }}\n"
        "compressibility {{ design_speed_m_per_s: 0.3 max_fall_or_depth_m: 0.004 }}\n"
        "effects {{ {4} }}\n"
        "tissue {{ plane {{ normal {{ z: 1.0 }} }} }}\n{5}",
        half_side, height, capacity, spacing, effects, more);
  }
};

}  // namespace bleedsim::test
