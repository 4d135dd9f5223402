// From a description to the constants that a world runs on.
#pragma once

#include <cmath>
#include <numbers>

#include "service/sph/effects/pair_set.h"
#include "service/sph/integrate/time_step.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/tissue/wall_effects.h"
#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// Wounds' throats may reach this far out of the domain, in spacings.
constexpr double kThroatMargin = 16.0;

/// The pair effects that a description enables, in their cheapest variant.
inline PairSet pairSet(const WorldDescription& description) {
  PairSet set;
  if (description.effects.pressure) set.pressure = PressureTerm::variational;
  if (description.effects.viscosity) {
    set.viscosity = ViscosityTerm::uniform;
    for (const FluidBlock& block : description.fluid_blocks) {
      if (block.viscosity && *block.viscosity != description.effects.viscosity->viscosity)
        set.viscosity = ViscosityTerm::harmonic;
    }
  }
  return set;
}

/// The largest viscosity of any particle, Pa s; 0 without the effect.
inline double largestViscosity(const WorldDescription& description) {
  if (!description.effects.viscosity) return 0.0;
  double largest = description.effects.viscosity->viscosity;
  for (const FluidBlock& block : description.fluid_blocks) largest = std::max(largest, block.viscosity.value_or(0.0));
  return largest;
}

inline TimeStepLimits timeStepLimits(const WorldDescription& description, double speed_of_sound) {
  TimeStepLimits limits;
  limits.spacing = description.spacing;
  limits.speed_of_sound = speed_of_sound;
  limits.scene = description.max_dt;
  const double viscosity = largestViscosity(description);
  const double h = description.supportRadius();
  if (viscosity > 0.0) limits.viscous = 0.045 * h * h * description.rest_density / viscosity;
  return limits;
}

/// Prefactors of pressure-inl.h and viscosity-inl.h.
template <class Real>
PairConstants<Real> pairConstants(const WorldDescription& description, const RestLattice& lattice, double speed_of_sound) {
  const double h = description.supportRadius();
  const double per_volume = lattice.particle_mass / (std::numbers::pi * h * h * h);
  PairConstants<Real> constants;
  constants.mass_weight = static_cast<Real>(10.5 * per_volume);
  constants.rest_density = static_cast<Real>(description.rest_density);
  if (description.effects.pressure) {
    constants.stiffness = static_cast<Real>(speed_of_sound * speed_of_sound);
    constants.background = static_cast<Real>(description.effects.pressure->background_pressure);
    constants.pressure_scale = static_cast<Real>(210.0 * per_volume / h);
  }
  if (description.effects.viscosity) {
    const double scale = 420.0 * per_volume / (h * h) * lattice.viscosity_factor;
    const bool harmonic = pairSet(description).viscosity == ViscosityTerm::harmonic;
    constants.viscosity_scale = static_cast<Real>(scale * (harmonic ? 2.0 : description.effects.viscosity->viscosity));
  }
  return constants;
}

template <class Real>
WallConstants<Real> wallConstants(const WorldDescription& description, const RestLattice& lattice, double speed_of_sound) {
  WallConstants<Real> constants;
  constants.h = static_cast<Real>(description.supportRadius());
  constants.rest_density = static_cast<Real>(description.rest_density);
  constants.speed_of_sound2 = static_cast<Real>(speed_of_sound * speed_of_sound);
  constants.pressure = description.effects.pressure.has_value();
  if (description.effects.viscosity) {
    constants.viscosity_factor = static_cast<Real>(lattice.viscosity_factor);
    constants.viscosity = static_cast<Real>(description.effects.viscosity->viscosity);
  }
  return constants;
}

}  // namespace bleedsim::sph
