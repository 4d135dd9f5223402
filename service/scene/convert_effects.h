// The effects of a valid scene in SI units.
#pragma once

#include "idl/scene.pb.h"
#include "service/sph/effect_settings.h"

namespace bleedsim::scene {

/// The message must have its defaults filled in and no problems. `spline`: the scene's kernel is the cubic spline, which knows
/// the explicit viscosity only.
sph::EffectSettings convertEffects(const Effects& effects, bool spline);

/// Of a scene with model LITERAL, its defaults filled in.
sph::LiteralSettings convertLiteral(const Literal& literal);
/// Bits of sph::FrameAttribute.
std::uint32_t convertAttributes(const Output& output);

}  // namespace bleedsim::scene
