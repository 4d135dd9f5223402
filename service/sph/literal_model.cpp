#include "service/sph/literal_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "service/sph/effects/literal_core_radius.h"
#include "service/sph/own_math.h"
#include "service/sph/seeding.h"

namespace bleedsim::sph {
namespace {

Status invalid(std::string message) { return {StatusCode::invalid_argument, std::move(message)}; }
Status unsupported(std::string message) { return {StatusCode::unsupported, std::move(message)}; }

bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }
bool isNotNegative(double value) { return value >= 0.0 && std::isfinite(value); }

Status checkNumbers(const WorldDescription& d) {
  const LiteralSettings& s = d.literal;
  if (s.stiffness && !isPositive(*s.stiffness)) return invalid("literal.stiffness must be greater than 0 m^2/s^2");
  if (!isNotNegative(s.tension)) return invalid("literal.tension must be finite and not negative");
  if (!isNotNegative(s.normal_cutoff)) return invalid("literal.normal_cutoff must be finite and not negative");
  if (!isPositive(s.thickening)) return invalid("literal.thickening must be greater than 0 Pa s");
  if (s.thickening_exponent && !isNotNegative(*s.thickening_exponent)) {
    return invalid("literal.thickening_exponent must be finite and not negative");
  }
  if (!isNotNegative(s.platelet_diffusivity)) return invalid("literal.platelet_diffusivity must be finite and not negative");
  if (s.repulsion && !isNotNegative(*s.repulsion)) return invalid("literal.repulsion must be finite and not negative");
  if (s.power_2 < 1 || s.power_1 <= s.power_2 || s.power_1 > 12) {
    return invalid("literal.power_1 must be greater than literal.power_2, both 1 to 12");
  }
  if (!isPositive(s.contact_radius) || s.contact_radius > 0.5 * d.support_ratio) {
    return invalid("literal.contact_radius must be greater than 0 and at most half a support radius, " +
                   std::to_string(0.5 * d.support_ratio) + " spacings");
  }
  for (const FluidBlock& block : d.fluid_blocks) {
    if (block.platelet && !(*block.platelet >= 0.0 && *block.platelet <= 1.0)) {
      return invalid("a fluid block's platelet must be 0 to 1");
    }
  }
  if (d.effects.viscosity && d.effects.platelets) {
    if (!isPositive(d.effects.platelets->fresh)) return invalid("platelets.fresh must be greater than 0 for equation (26)");
    if (!s.thickening_exponent && !isPositive(d.effects.viscosity->viscosity)) {
      return invalid("with platelets the viscosity must be greater than 0 Pa s");
    }
  }
  return {};
}

}  // namespace

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

Status checkLiteral(const WorldDescription& d) {
  if (d.model != Model::literal) return {};
  const EffectSettings& effects = d.effects;
  if (effects.adhesion) return unsupported("the paper has no adhesion; remove it or use the sound model");
  if (effects.pressure && effects.pressure->background_pressure != 0.0) {
    return unsupported("the paper has no background pressure; leave it at 0 Pa or use the sound model");
  }
  if (effects.viscosity) {
    if (!std::holds_alternative<NewtonianRheology>(effects.viscosity->rheology)) {
      return unsupported("the paper's viscosity does not depend on the shear rate; use the Newtonian one or the sound model");
    }
    if (effects.viscosity->solve == ViscositySolve::implicit) {
      return unsupported("the literal model has no implicit viscosity; solve it explicitly or use the sound model");
    }
  }
  if (effects.surface_tension && effects.surface_tension->contact_angle) {
    return unsupported("the paper has no contact angle; remove it or use the sound model");
  }
  return checkNumbers(d);
}

Status checkPlanar(const WorldDescription& d) {
  if (!d.planar) return {};
  const EffectSettings& effects = d.effects;
  if (!d.tissue.empty() || !d.wounds.empty()) return unsupported("a planar world has neither tissue nor wounds");
  const bool sound = d.model == Model::sound;
  if (sound && (effects.surface_tension || effects.platelets || effects.core_radius || effects.adhesion)) {
    return unsupported(
        "a planar world of the sound model has gravity, pressure, viscosity, repulsion and applied_force only; use the literal "
        "model for surface tension and platelets");
  }
  if (sound && effects.viscosity &&
      (!std::holds_alternative<NewtonianRheology>(effects.viscosity->rheology) ||
       effects.viscosity->solve == ViscositySolve::implicit)) {
    return unsupported("a planar world has Newtonian viscosity, solved explicitly");
  }
  if (effects.viscosity && effects.viscosity->solve == ViscositySolve::implicit) {
    return unsupported("a planar world has no implicit viscosity");
  }
  for (const FluidBlock& block : d.fluid_blocks) {
    if (blockLattice(block, d.spacing)[2] != 1) return invalid("a planar world's fluid blocks are one particle high");
    if (block.lower.z() != d.fluid_blocks.front().lower.z()) return invalid("a planar world's fluid blocks stand at one height");
    if (block.velocity.z() != 0.0) return invalid("a planar world's fluid blocks move in the plane");
  }
  return {};
}

template LiteralJob<float> literalJob(const WorldDescription&, const RestLattice&, double, bool);
template LiteralJob<double> literalJob(const WorldDescription&, const RestLattice&, double, bool);

}  // namespace bleedsim::sph
