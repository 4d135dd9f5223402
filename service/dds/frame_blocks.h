// The optional blocks of a frame: the solver's attribute, its meaning on the wire, and where its values stand.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "idl/bleed.h"
#include "service/sph/world.h"

namespace bleedsim::dds {

struct FrameBlock {
  sph::FrameAttribute attribute;
  std::uint32_t semantic;
  std::uint8_t components;
  std::vector<float> sph::FrameBuffer::*values;
  std::string_view name;
  std::string_view effect;  ///< that it needs; empty: none
};

/// In the order in which a frame holds them, after positions and ids.
inline constexpr std::array<FrameBlock, 5> kFrameBlocks{{
    {sph::kFrameVelocity, bleed_v1_SEMANTIC_VELOCITY, 3, &sph::FrameBuffer::velocity, "velocity", ""},
    {sph::kFrameDensity, bleed_v1_SEMANTIC_DENSITY, 1, &sph::FrameBuffer::density, "density", ""},
    {sph::kFrameViscosity, bleed_v1_SEMANTIC_VISCOSITY, 1, &sph::FrameBuffer::viscosity, "viscosity", "viscosity"},
    {sph::kFramePlatelet, bleed_v1_SEMANTIC_PLATELET, 1, &sph::FrameBuffer::platelet, "platelet", "platelets"},
    {sph::kFrameRadius, bleed_v1_SEMANTIC_RADIUS, 1, &sph::FrameBuffer::radius, "radius", "core_radius"},
}};

/// Bits of every block.
constexpr std::uint32_t allFrameAttributes() {
  std::uint32_t bits = 0;
  for (const FrameBlock& block : kFrameBlocks) bits |= block.attribute;
  return bits;
}

}  // namespace bleedsim::dds
