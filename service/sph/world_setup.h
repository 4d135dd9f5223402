// From a description to the constants that a world runs on.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>

#include "service/sph/effects/literal_core_radius.h"
#include "service/sph/effects/pair_set.h"
#include "service/sph/effects/rheology.h"
#include "service/sph/integrate/closing_kick.h"
#include "service/sph/integrate/time_step.h"
#include "service/sph/literal_model.h"
#include "service/sph/passes/pair_passes.h"
#include "service/sph/passes/sweep_table.h"
#include "service/sph/rest_lattice.h"
#include "service/sph/tissue/wall_effects.h"
#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// Wounds' throats may reach this far out of the domain, in spacings.
constexpr double kThroatMargin = 16.0;

/// Of particles' own support radii, over h.
inline RadiusBounds radiusBounds(const WorldDescription& description) {
  const auto& core_radius = description.effects.core_radius;
  if (!core_radius) return {};
  if (description.model == Model::literal) return literalRadiusBounds(description.support_ratio);
  return {core_radius->smallest, core_radius->largest};
}

template <class Real>
std::optional<LatticeFactors<Real>> latticeFactors(const WorldDescription& description) {
  if (!description.effects.core_radius || description.model == Model::literal) return std::nullopt;
  return LatticeFactors<Real>{{description.kernel, description.supportRadius()}, description.spacing, radiusBounds(description)};
}

/// Whether particles differ in viscosity: by their block, their shear rate, their platelets or, in the sound model, their support
/// radius.
inline bool viscosityVaries(const WorldDescription& description) {
  const EffectSettings& effects = description.effects;
  if (!effects.viscosity) return false;
  if (viscosityChanges(effects) || (effects.core_radius && description.model == Model::sound)) return true;
  for (const FluidBlock& block : description.fluid_blocks) {
    if (block.viscosity && *block.viscosity != effects.viscosity->viscosity) return true;
  }
  return false;
}

/// The pair effects that a description enables, in their cheapest variant.
inline PairSet pairSet(const WorldDescription& description) {
  PairSet set;
  const EffectSettings& effects = description.effects;
  if (effects.pressure) {
    set.pressure = effects.pressure->form == PressureForm::symmetric ? PressureTerm::symmetric : PressureTerm::variational;
  }
  set.tension = effects.surface_tension.has_value();
  set.repulsion = effects.repulsion.has_value();
  set.core_radius = effects.core_radius.has_value();
  if (effects.viscosity) set.viscosity = viscosityVaries(description) ? ViscosityTerm::harmonic : ViscosityTerm::uniform;
  return set;
}

/// The largest viscosity that any particle can have at the start, Pa s; 0 without the effect. Where viscosity changes, the time
/// step then follows that of the moment.
inline double largestViscosity(const WorldDescription& description) {
  const EffectSettings& effects = description.effects;
  if (!effects.viscosity) return 0.0;
  if (description.model == Model::literal) return largestLiteralViscosity(description);
  const auto clotted = [&](double fresh, std::optional<double> platelet) {
    if (!effects.platelets) return fresh;
    return thickened(fresh, effects.platelets->clot_viscosity, platelet.value_or(effects.platelets->fresh));
  };
  const double rest = viscosityAtRest<double>(*effects.viscosity);
  double largest = clotted(rest, std::nullopt);
  for (const FluidBlock& block : description.fluid_blocks) {
    largest = std::max(largest, clotted(block.viscosity.value_or(rest), block.platelet));
  }
  return largest;
}

/// 0.045 h^2/nu, s: 0.06 goes unstable at walls; nu > 0 in m^2/s.
inline double diffusionLimit(const WorldDescription& description, double nu) {
  const double h = description.supportRadius() * radiusBounds(description).smallest;
  return 0.045 * h * h / nu;
}

/// The largest viscosity that any particle can come to have, Pa s: by its block, at rest, or clotted.
inline double largestPossibleViscosity(const WorldDescription& description) {
  if (!description.effects.viscosity) return 0.0;
  double largest = largestViscosity(description);
  if (description.effects.platelets) largest = std::max(largest, description.effects.platelets->clot_viscosity);
  return largest;
}

/// Whether viscosity is solved implicitly, or may come to be.
inline bool mayNeedImplicitViscosity(const WorldDescription& description, double speed_of_sound) {
  const auto& viscosity = description.effects.viscosity;
  if (!viscosity || viscosity->solve == ViscositySolve::explicit_) return false;
  if (description.model == Model::literal || description.planar) return false;
  if (description.kernel != KernelType::wendland_c2) return false;  // its sweeps are compiled for one kernel
  if (viscosity->solve == ViscositySolve::implicit) return true;
  const double viscous = diffusionLimit(description, largestPossibleViscosity(description) / description.rest_density);
  return viscous < acousticLimit(description.spacing, speed_of_sound);
}

/// TimeStepLimits::contact: 0.1 where a touching pair is as stiff as with the default settings, shorter as the frequency of a
/// harder one, w^2 = 2 D* (n1 - n2)/(contact distance/dx)^3 (c0/dx)^2 at first touch; 0 without the effect.
inline double contactLimit(const std::optional<RepulsionSettings>& repulsion) {
  if (!repulsion) return 0.0;
  const auto stiffness = [](const RepulsionSettings& r) {
    return r.strength * (r.power_1 - r.power_2) / (r.contact_distance * r.contact_distance * r.contact_distance);
  };
  const double harder = stiffness(*repulsion) / stiffness(RepulsionSettings{});
  return harder > 1.0 ? 0.1 / std::sqrt(harder) : 0.1;
}

/// The largest pe that a pair feels: where its push, D* (pe^n1 - pe^n2) pe^2/(contact distance/dx)^2 c0^2/dx, is 0.85 of the
/// bound on accelerations, and at most 2. The bound acts on one particle alone and so takes momentum: a pair by itself must not
/// reach it. Not less, because at 0.75 a collision at c0 comes to where the push stops growing, and finite steps gain energy
/// there.
inline double contactOverlap(const RepulsionSettings& repulsion) {
  const auto power = [](double base, int exponent) {  // libm's pow has other bits on other machines
    double result = base;
    for (int k = 1; k < exponent; ++k) result *= base;
    return result;
  };
  const auto push = [&](double pe) {
    return repulsion.strength * (power(pe, repulsion.power_1) - power(pe, repulsion.power_2)) * pe * pe /
           (repulsion.contact_distance * repulsion.contact_distance);
  };
  constexpr double kMost = 0.85 * kAccelerationBound;
  double below = 1.0;
  double above = 2.0;
  if (push(above) <= kMost) return above;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (below + above);
    (push(middle) <= kMost ? below : above) = middle;
  }
  return below;
}

inline TimeStepLimits timeStepLimits(const WorldDescription& description, double speed_of_sound) {
  TimeStepLimits limits;
  limits.spacing = description.spacing;
  limits.speed_of_sound = speed_of_sound;
  limits.scene = description.max_dt;
  const double viscosity = largestViscosity(description);
  if (viscosity > 0.0) limits.viscous = diffusionLimit(description, viscosity / description.rest_density);
  if (description.model == Model::literal) {
    limits.scene = std::min(limits.scene, literalTimeStep(description, speed_of_sound));
    return limits;
  }
  limits.contact = contactLimit(description.effects.repulsion);
  if (const auto& tension = description.effects.surface_tension; tension && tension->coefficient > 0.0) {
    const double spacing3 = description.particleVolume();
    limits.capillary = 0.25 * std::sqrt(description.rest_density * spacing3 / (2.0 * std::numbers::pi * tension->coefficient));
  }
  if (const auto& platelets = description.effects.platelets; platelets && platelets->diffusivity > 0.0) {
    limits.diffusive = diffusionLimit(description, platelets->diffusivity);
  }
  return limits;
}

/// Of the kernel for density and of that for the pressure's gradient, over pi h^3 in a planar world, too.
inline KernelNorms pairNorms(const WorldDescription& description) {
  const bool literal = description.model == Model::literal;
  const KernelNorms density = kernelNorms(description.densityKernel().type, description.planar);
  const KernelNorms gradient = literal ? kernelNorms(KernelType::spiky, description.planar) : density;
  const double layers = description.planar ? description.support_ratio : 1.0;
  return {layers * density.weight, layers * gradient.gradient};
}

/// The prefactor K of viscosity-inl.h and platelets-inl.h, 2 m norm/h^5 and the rest lattice's factor.
inline double laplacianPrefactor(const WorldDescription& description, const RestLattice& lattice) {
  const double h = description.supportRadius();
  const double per_volume = lattice.particle_mass / (std::numbers::pi * h * h * h);
  return 2.0 * pairNorms(description).gradient * per_volume / (h * h) * lattice.viscosity_factor;
}

/// Prefactors of pressure-inl.h and viscosity-inl.h.
template <class Real>
PairConstants<Real> pairConstants(const WorldDescription& description, const RestLattice& lattice, double speed_of_sound) {
  const double h = description.supportRadius();
  const double per_volume = lattice.particle_mass / (std::numbers::pi * h * h * h);
  const KernelNorms norms = pairNorms(description);
  PairConstants<Real> constants;
  constants.mass_weight = static_cast<Real>(norms.weight * per_volume);
  constants.rest_density = static_cast<Real>(description.rest_density);
  if (description.effects.pressure) {
    constants.stiffness = static_cast<Real>(speed_of_sound * speed_of_sound);
    constants.background = static_cast<Real>(description.effects.pressure->background_pressure);
  }
  if (description.model == Model::literal) {
    if (description.effects.pressure) constants.stiffness = static_cast<Real>(literalStiffness(description, speed_of_sound));
    constants.pressure_floor = std::numeric_limits<Real>::lowest();
    return constants;  // the rest is literalJob's
  }
  if (description.effects.pressure) constants.pressure_scale = static_cast<Real>(norms.gradient * per_volume / h);
  if (description.effects.viscosity) {
    const double mean = viscosityVaries(description) ? 2.0 : description.effects.viscosity->viscosity;
    constants.viscosity_scale = static_cast<Real>(laplacianPrefactor(description, lattice) * mean);
  }
  if (const auto& repulsion = description.effects.repulsion) {
    constants.repulsion_scale =
        static_cast<Real>(repulsion->strength * speed_of_sound * speed_of_sound * description.spacing / (h * h));
    constants.repulsion_contact = static_cast<Real>(repulsion->contact_distance * description.spacing / h);
    constants.repulsion_overlap = static_cast<Real>(contactOverlap(*repulsion));
    constants.repulsion_damping = static_cast<Real>(repulsion->damping * speed_of_sound / description.spacing);
    constants.repulsion_powers[0] = repulsion->power_1;
    constants.repulsion_powers[1] = repulsion->power_2;
  }
  return constants;
}

inline PassChoice passChoice(const WorldDescription& description) {
  const auto& periodic = description.domain.periodic;
  return {description.kernel, periodic[0] || periodic[1] || periodic[2], description.model == Model::literal};
}

inline SweepChoice sweepChoice(const WorldDescription& description) {
  return {passChoice(description).periodic, description.effects.core_radius.has_value()};
}

inline PairLayout pairLayout(const WorldDescription& description) {
  if (description.model == Model::literal) {
    const LiteralSet set = literalSet(description);
    return {.set = {.pressure = set.pressure, .core_radius = set.core_radius},
            .tissue = !description.tissue.empty(),
            .planar = description.planar,
            .least_groups = literalRecordGroups(set),
            .platelet_field = kRecordLiteralPlatelet};
  }
  return {.set = pairSet(description),
          .tissue = !description.tissue.empty(),
          .least_groups = description.effects.platelets ? kPlateletGroups : 1};
}

/// The arrays that a description calls for.
template <class Real>
typename Particles<Real>::Fields particleFields(const WorldDescription& description) {
  typename Particles<Real>::Fields fields;
  fields.viscosity = viscosityVaries(description);
  fields.platelet = description.effects.platelets.has_value();
  fields.radius = description.effects.core_radius.has_value();
  for (const FluidBlock& block : description.fluid_blocks) {
    fields.own_viscosity = fields.own_viscosity || (block.viscosity && viscosityChanges(description.effects));
  }
  return fields;
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
  if (const auto& adhesion = description.effects.adhesion) {
    constants.adhesion = {static_cast<Real>(adhesion->acceleration), static_cast<Real>(description.spacing), constants.h};
  }
  return constants;
}

}  // namespace bleedsim::sph
