#include "service/sph/literal_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "service/sph/effects/literal_core_radius.h"
#include "service/sph/own_math.h"

namespace bleedsim::sph {

LiteralSet literalSet(const WorldDescription& description) {
  const EffectSettings& effects = description.effects;
  LiteralSet set;
  if (effects.pressure) {
    set.pressure = description.literal.pressure == PressureForm::symmetric ? PressureTerm::symmetric : PressureTerm::variational;
  }
  set.tension = effects.surface_tension.has_value();
  set.viscosity = effects.viscosity.has_value();
  set.platelets = effects.platelets.has_value();
  set.repulsion = effects.repulsion.has_value();
  set.core_radius = effects.core_radius.has_value();
  return set;
}

Thickening thickening(const WorldDescription& description) {
  const double b = description.literal.thickening;
  const double fresh = description.effects.platelets->fresh;
  return {b, description.literal.thickening_exponent.value_or(ownLog(b / description.effects.viscosity->viscosity) / fresh)};
}

double largestLiteralViscosity(const WorldDescription& description) {
  const EffectSettings& effects = description.effects;
  if (!effects.viscosity) return 0.0;
  if (effects.platelets) {
    const Thickening law = thickening(description);
    double largest = law.scale * ownExp(-law.exponent * effects.platelets->fresh);
    for (const FluidBlock& block : description.fluid_blocks) {
      if (block.platelet) largest = std::max(largest, law.scale * ownExp(-law.exponent * *block.platelet));
    }
    return largest;
  }
  double largest = effects.viscosity->viscosity;
  for (const FluidBlock& block : description.fluid_blocks) largest = std::max(largest, block.viscosity.value_or(0.0));
  return largest;
}

double literalStiffness(const WorldDescription& description, double speed_of_sound) {
  return description.literal.stiffness.value_or(speed_of_sound * speed_of_sound);
}

double literalTimeStep(const WorldDescription& description, double speed_of_sound) {
  const EffectSettings& effects = description.effects;
  const LiteralSettings& literal = description.literal;
  const double smallest = effects.core_radius ? literalRadiusBounds(description.support_ratio).smallest : 1.0;
  const double least = smallest * description.supportRadius();
  double dt = std::numeric_limits<double>::infinity();
  if (effects.surface_tension && literal.tension > 0.0) {
    dt = 0.25 * std::sqrt(description.rest_density * description.particleVolume() / (2.0 * std::numbers::pi * literal.tension));
  }
  if (effects.platelets && literal.platelet_diffusivity > 0.0)
    dt = std::min(dt, 0.045 * least * least / literal.platelet_diffusivity);
  if (effects.repulsion) dt = std::min(dt, 0.1 * description.spacing / speed_of_sound);
  return dt;
}

template <class Real>
LiteralJob<Real> literalJob(const WorldDescription& description, const RestLattice& lattice, double speed_of_sound,
                            bool viscosity_varies) {
  const EffectSettings& effects = description.effects;
  const LiteralSettings& literal = description.literal;
  const double h = description.supportRadius();
  const double mass = lattice.particle_mass;
  const double depth = description.planar ? description.spacing : h;
  const double per_volume = mass / (std::numbers::pi * h * h * depth);
  const double spiky = kernelNorms(KernelType::spiky, description.planar).gradient * per_volume;
  const double laplacian = viscosityLaplacianNorm(description.planar) * per_volume / (h * h);
  LiteralJob<Real> job;
  if (effects.pressure) {
    const double scale = (literal.pressure == PressureForm::symmetric ? 0.5 : 1.0) * spiky / h;
    const double stiffness = literalStiffness(description, speed_of_sound);
    job.pressure_slope = static_cast<Real>(scale * stiffness);
    job.pressure_constant =
        static_cast<Real>(scale * (effects.pressure->background_pressure - stiffness * description.rest_density));
  }
  if (effects.viscosity) {
    job.viscosity_scale = static_cast<Real>(laplacian * (viscosity_varies ? 1.0 : effects.viscosity->viscosity));
  }
  job.platelet_scale = static_cast<Real>(laplacian * literal.platelet_diffusivity);
  job.tension_scale = static_cast<Real>(literal.tension * spiky / (h * h));
  job.tension_cutoff2 = static_cast<Real>(literal.normal_cutoff * literal.normal_cutoff / (spiky * spiky));
  job.turns = description.planar ? Real(1) : Real(2);
  const double strength = literal.repulsion.value_or(1.5 * mass * speed_of_sound * speed_of_sound * description.spacing);
  job.repulsion_scale = static_cast<Real>(strength / (mass * h * h));
  job.contact = static_cast<Real>(2.0 * literal.contact_radius * description.spacing / h);
  job.repulsion_powers[0] = literal.power_1;
  job.repulsion_powers[1] = literal.power_2;
  return job;
}

template LiteralJob<float> literalJob(const WorldDescription&, const RestLattice&, double, bool);
template LiteralJob<double> literalJob(const WorldDescription&, const RestLattice&, double, bool);

}  // namespace bleedsim::sph
