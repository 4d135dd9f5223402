// Scene texts that the tests start from.
#pragma once

#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace bleedsim::scene {

/// Valid, and such that a world can be made of it, with one of nearly everything; the rules' tests replace one piece of it.
inline constexpr std::string_view kFullScene = R"(name: "full"
description: "all of it"
frame_id: "table"
seed: 7
domain {
  lower_m { x: -0.05 y: -0.05 z: -0.02 }
  upper_m { x: 0.05 y: 0.05 z: 0.05 }
  periodic_x: true
  capacity: 5000
}
resolution { spacing_m: 0.002 support_ratio: 2.5 }
fluid { density_kg_per_m3: 1050 }
compressibility { mach_factor: 12 design_speed_m_per_s: 0.4 max_fall_or_depth_m: 0.01 }
effects {
  gravity { acceleration_m_per_s2 { z: -9.5 } }
  pressure { background_pressure_pa: 3 }
  viscosity { viscosity_pa_s: 0.005 }
  applied_force { max_sources: 8 }
}
tissue { name: "floor" plane { point_m { z: -0.001 } normal { z: 2 } } slip: 0.25 }
tissue { name: "tray" box { lower_m { x: -0.04 y: -0.04 z: 0 } upper_m { x: 0.04 y: 0.04 z: 0.04 } open_top: true } }
tissue { name: "organ" bowl { rim_center_m { z: -0.002 } sphere_radius_m: 0.03 depth_m: 0.01 } }
wounds { name: "a" position_m { x: 0.01 } normal { z: 3 } disc { radius_m: 0.003 } flow_ml_per_s: 2 }
wounds { name: "b" position_m { y: 0.02 } tangent { x: 1 } ellipse { semi_axis_u_m: 0.002 semi_axis_v_m: 0.001 }
         pressure { inlet_pressure_mmhg: 1 discharge_coefficient: 0.7 } }
wounds { name: "c" position_m { y: -0.02 } polygon { points_m { u: -0.003 } points_m { u: 0.003 } points_m { v: 0.004 } } flow_ml_per_s: 1 }
wounds { name: "d" position_m { x: -0.025 } polyline { points_m { u: -0.005 } points_m { u: 0.005 } width_m: 0.0015 } flow_ml_per_s: 0.5 }
fluid_blocks { lower_m { x: 0.02 y: 0.02 z: 0.01 } upper_m { x: 0.03 y: 0.03 z: 0.02 }
               velocity_m_per_s { x: 0.5 } jitter: 0.1 viscosity_pa_s: 0.006 }
fluid_blocks { lower_m { x: 0.03 y: 0.02 z: 0.01 } upper_m { x: 0.04 y: 0.03 z: 0.02 } }
output { frame_rate_hz: 30 attributes: VELOCITY attributes: VISCOSITY }
commands { instrument_expiry_s: 0.2 max_wounds: 9 }
max_dt_s: 0.01
)";

/// The least that is valid.
inline constexpr std::string_view kLeastScene = R"(domain { lower_m {} upper_m { x: 0.1 y: 0.1 z: 0.1 } capacity: 10 }
resolution { spacing_m: 0.002 }
compressibility { design_speed_m_per_s: 0.3 }
)";

/// The text with the first `from` replaced; the test fails if `from` is not there.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result{text};
  const std::size_t at = result.find(from);
  EXPECT_NE(at, std::string::npos) << "'" << from << "' is not in the scene";
  if (at != std::string::npos) result.replace(at, from.size(), to);
  return result;
}

inline std::string repeated(std::string_view text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

}  // namespace bleedsim::scene
