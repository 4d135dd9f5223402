// Scenes of the literal model for the tests of this folder.
#pragma once

#include <string>
#include <vector>

#include "service/sph/literal_model.h"
#include "tests/unit/sph/pass_rig.h"

namespace bleedsim::sph {

/// Every set of the paper's terms, the empty one included.
inline std::vector<LiteralSet> allLiteralSets() {
  std::vector<LiteralSet> sets;
  for (std::size_t k = 0; k < LiteralSet::kCount; ++k) sets.push_back(LiteralSet::at(k));
  return sets;
}

inline std::string nameOf(LiteralSet set) {
  std::string name;
  if (set.pressure == PressureTerm::variational) name += "Pressure16";
  if (set.pressure == PressureTerm::symmetric) name += "Pressure17";
  if (set.tension) name += "Tension";
  if (set.viscosity) name += "Viscosity";
  if (set.platelets) name += "Platelets";
  if (set.repulsion) name += "Repulsion";
  if (set.core_radius) name += "CoreRadius";
  return name.empty() ? "Nothing" : name;
}

/// The description in the literal model with the terms of `set` and no other pair effect.
inline WorldDescription literal(WorldDescription description, LiteralSet set) {
  description.model = Model::literal;
  EffectSettings& effects = description.effects;
  effects.pressure.reset();
  effects.viscosity.reset();
  if (set.pressure != PressureTerm::none) effects.pressure.emplace();
  if (set.pressure == PressureTerm::variational) description.literal.pressure = PressureForm::variational;
  if (set.tension) effects.surface_tension.emplace();
  if (set.viscosity) effects.viscosity.emplace();
  if (set.platelets) effects.platelets.emplace();
  if (set.repulsion) effects.repulsion.emplace();
  if (set.core_radius) effects.core_radius.emplace();
  return description;
}

/// A square of one layer in the plane z = 0.5 mm, the domain's sides 1 mm x counts wide and centred.
inline WorldDescription layer(int along_x, int along_y, double jitter = 0.0) {
  WorldDescription description = test::freeBlock({along_x, along_y, 1}, jitter);
  description.planar = true;
  description.fluid_blocks.front().lower.z() = 0.0;
  description.fluid_blocks.front().upper.z() = description.spacing;
  return description;
}

/// stirred() of a planar description: nothing out of the plane.
inline test::OracleParticles stirredLayer(const WorldDescription& description) {
  test::OracleParticles particles = stirred(description);
  for (Vec3& position : particles.position) position.z() = 0.5 * description.spacing;
  for (Vec3& velocity : particles.velocity) velocity.z() = 0.0;
  return particles;
}

}  // namespace bleedsim::sph
