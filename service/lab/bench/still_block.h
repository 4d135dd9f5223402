// The blocks that `bleedlab bench --model` measures: blood that keeps its shape in free space, so that every version of the
// solver sees the same neighbours.
//
// round(cbrt N)^3 particles, 1 mm apart, h = 2 dx, each coordinate moved by up to 0.3 dx; no tissue, no wounds, sides far away; a
// step is 2e-6 s. c0 = 1 m/s, mu = 4 mPa s. Repulsion reaches 0.9 dx and is weak: at its default the disordered block would
// burst, and a step costs the same whatever the strength.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "service/sph/world_description.h"

namespace bleedsim::lab {

enum class BlockModel {
  paper,    ///< the literal model in one sweep: (16), (25), the colour field (21)-(23), (27), (36); gravity
  reduced,  ///< the sound model's pressure, viscosity and gravity
  full,     ///< all of the sound model but adhesion and applied forces, which act on few particles: curvature tension, platelets
            ///< that clot, (34), (36)
};

/// "paper", "reduced", "full"
const std::vector<std::string>& blockModelNames();
/// `name` is one of them.
BlockModel blockModelOf(const std::string& name);

inline constexpr double kBlockStep = 2e-6;  ///< s

/// `particles`: about how many.
sph::WorldDescription stillBlock(BlockModel model, std::uint32_t particles);

}  // namespace bleedsim::lab
