// A scene with every effect on, for the tests of their rules.
#pragma once

#include <string_view>

namespace bleedsim::scene {

inline constexpr std::string_view kEffectScene = R"(name: "effects"
domain { lower_m { x: -0.05 y: -0.05 z: -0.02 } upper_m { x: 0.05 y: 0.05 z: 0.05 } periodic_y: true capacity: 5000 }
resolution { spacing_m: 0.002 support_ratio: 2.5 kernel: WENDLAND_C2 }
compressibility { design_speed_m_per_s: 0.4 }
effects {
  gravity {}
  pressure { form: SYMMETRIC }
  viscosity {
    carreau_yasuda { zero_shear_pa_s: 0.06 infinite_shear_pa_s: 0.004 time_s: 3.5 power: 0.4 transition: 1.9 }
    solve: IMPLICIT
    solve_tolerance: 0.02
    max_iterations: 50
  }
  applied_force {}
  surface_tension { temperature_c: 37 normal_cutoff: 0.4 contact_angle_deg: 40 }
  platelets { fresh: 0.98 diffusivity_m2_per_s: 2e-9 activation_rate_per_s: 0.02 wall_rate_per_s: 0.03 air_rate_per_s: 0.004
              shear_gate_per_s: 300 clot_viscosity_pa_s: 9 clot_speedup: 50 }
  core_radius { smallest: 0.8 largest: 1.2 relaxation: 0.2 }
  repulsion { strength: 1.2 contact_distance: 0.85 power_1: 7 power_2: 3 damping: 0.5 }
  adhesion { acceleration_m_per_s2: 6 }
  auto: "platelets"
}
tissue { plane { normal { z: 1 } } }
wounds { disc { radius_m: 0.003 } flow_ml_per_s: 2 }
output { attributes: VISCOSITY attributes: PLATELET attributes: RADIUS }
horizon_s: 20
model: SOUND
)";

}  // namespace bleedsim::scene
