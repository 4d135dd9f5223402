#include "service/sph/model_rules.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "service/sph/effects/rheology.h"
#include "service/sph/seeding.h"

namespace bleedsim::sph {
namespace {

class Problems {
 public:
  void invalid(std::string_view field, std::string message) { add(field, StatusCode::invalid_argument, std::move(message)); }
  void unsupported(std::string_view field, std::string message) { add(field, StatusCode::unsupported, std::move(message)); }
  void invalidBlock(std::size_t block, std::string_view field, std::string message) {
    invalid(field, std::move(message));
    found_.back().block = block;
  }
  std::vector<ModelProblem> take() { return std::move(found_); }

 private:
  void add(std::string_view field, StatusCode code, std::string message) {
    found_.push_back({std::string{field}, {code, std::move(message)}, std::nullopt});
  }

  std::vector<ModelProblem> found_;
};

bool isPositive(double value) { return value > 0.0 && std::isfinite(value); }
bool isNotNegative(double value) { return value >= 0.0 && std::isfinite(value); }

std::string_view rheologyField(const ViscositySettings& viscosity) {
  return std::holds_alternative<CassonRheology>(viscosity.rheology) ? "effects.viscosity.casson"
                                                                    : "effects.viscosity.carreau_yasuda";
}

void findLiteralNumbers(const WorldDescription& d, Problems& problems) {
  const LiteralSettings& s = d.literal;
  if (s.stiffness && !isPositive(*s.stiffness)) problems.invalid("literal.stiffness", "must be greater than 0 m^2/s^2");
  if (!isNotNegative(s.tension)) problems.invalid("literal.tension", "must be finite and not negative");
  if (!isNotNegative(s.normal_cutoff)) problems.invalid("literal.normal_cutoff", "must be finite and not negative");
  if (!isPositive(s.thickening)) problems.invalid("literal.thickening", "must be greater than 0 Pa s");
  if (s.thickening_exponent && !isNotNegative(*s.thickening_exponent)) {
    problems.invalid("literal.thickening_exponent", "must be finite and not negative");
  }
  if (!isNotNegative(s.platelet_diffusivity)) problems.invalid("literal.platelet_diffusivity", "must be finite and not negative");
  if (s.repulsion && !isNotNegative(*s.repulsion)) problems.invalid("literal.repulsion", "must be finite and not negative");
  if (s.power_2 < 1 || s.power_1 <= s.power_2 || s.power_1 > 12) {
    problems.invalid("literal.power_1", "must be greater than literal.power_2, both 1 to 12");
  }
  if (!isPositive(s.contact_radius) || s.contact_radius > 0.5 * d.support_ratio) {
    problems.invalid("literal.contact_radius", "must be greater than 0 and at most half a support radius, " +
                                                   std::to_string(0.5 * d.support_ratio) + " spacings");
  }
  for (std::size_t i = 0; i < d.fluid_blocks.size(); ++i) {
    const auto& platelet = d.fluid_blocks[i].platelet;
    if (platelet && !(*platelet >= 0.0 && *platelet <= 1.0)) problems.invalidBlock(i, ".platelet", "must be 0 to 1");
  }
  if (d.effects.viscosity && d.effects.platelets) {
    if (!isPositive(d.effects.platelets->fresh)) {
      problems.invalid("effects.platelets.fresh", "must be greater than 0, because (26) finds its exponent by it");
    }
    if (!s.thickening_exponent && !isPositive(d.effects.viscosity->viscosity)) {
      problems.invalid("effects.viscosity", "must be greater than 0 Pa s, because (26) multiplies it");
    }
  }
}

}  // namespace

std::vector<ModelProblem> literalProblems(const WorldDescription& d) {
  if (d.model != Model::literal) return {};
  Problems problems;
  const EffectSettings& effects = d.effects;
  if (effects.adhesion) {
    problems.unsupported("effects.adhesion", "not in model LITERAL, because the paper has no equation for adhesion; drop it");
  }
  if (effects.pressure && effects.pressure->background_pressure != 0.0) {
    problems.unsupported("effects.pressure.background_pressure_pa",
                         "not in model LITERAL, because (19) has no background pressure; leave it at 0");
  }
  if (const auto& viscosity = effects.viscosity) {
    if (viscosityThins(effects)) {
      problems.unsupported(rheologyField(*viscosity),
                           "not in model LITERAL, because the paper's mu knows no shear rate; set viscosity_pa_s");
    }
    if (viscosity->solve == ViscositySolve::implicit) {
      problems.unsupported("effects.viscosity.solve",
                           "no implicit solve in model LITERAL, because the printed (25) is a pair sum; drop it");
    }
  }
  if (effects.surface_tension && effects.surface_tension->contact_angle) {
    problems.unsupported("effects.surface_tension.contact_angle_deg",
                         "no contact angle in model LITERAL, because (21)-(23) know no tissue; drop it");
  }
  findLiteralNumbers(d, problems);
  return problems.take();
}

std::vector<ModelProblem> planarProblems(const WorldDescription& d) {
  if (!d.planar) return {};
  Problems problems;
  const EffectSettings& effects = d.effects;
  if (!d.tissue.empty()) {
    problems.unsupported("tissue",
                         "not in a planar world, because its share of density is that of a half space; leave tissue out");
  }
  if (!d.wounds.empty()) {
    problems.unsupported("wounds", "not in a planar world, because blood comes up through its only layer; leave wounds out");
  }
  if (d.model == Model::sound) {
    if (effects.surface_tension) {
      problems.unsupported("effects.surface_tension",
                           "surface tension is not in a planar sound world, because it is fitted to drops in space; drop it");
    }
    if (effects.platelets) {
      problems.unsupported("effects.platelets", "not in a planar sound world, because air is found by gaps in space; drop them");
    }
    if (effects.core_radius) {
      problems.unsupported("effects.core_radius",
                           "not in a planar sound world, because (m/rho)^(1/3) is the law of space; drop it");
    }
    if (effects.adhesion) {
      problems.unsupported("effects.adhesion", "not in a planar world, because there is no tissue to stick to; drop it");
    }
    if (viscosityThins(effects)) {
      problems.unsupported(rheologyField(*effects.viscosity),
                           "not in a planar world, because the shear rate is summed in space; set viscosity_pa_s");
    }
    if (effects.viscosity && effects.viscosity->solve == ViscositySolve::implicit) {
      problems.unsupported("effects.viscosity.solve",
                           "no implicit solve in a planar world, because its sweeps are made for space; drop it");
    }
  }
  for (std::size_t i = 0; i < d.fluid_blocks.size(); ++i) {
    const FluidBlock& block = d.fluid_blocks[i];
    if (blockLattice(block, d.spacing)[2] != 1) {
      problems.invalidBlock(i, "", "must be one particle high, because a planar world has one layer");
    }
    if (block.lower.z() != d.fluid_blocks.front().lower.z()) {
      problems.invalidBlock(i, "", "must stand at one height with the first, because a planar world has one layer");
    }
    if (std::abs(block.velocity.z()) > 0.0) {
      problems.invalidBlock(i, ".velocity_m_per_s", "must be in the plane, because a planar world does not move along z");
    }
  }
  return problems.take();
}

Status checkModel(const WorldDescription& description) {
  for (const auto& find : {literalProblems, planarProblems}) {
    const std::vector<ModelProblem> problems = find(description);
    if (problems.empty()) continue;
    const ModelProblem& first = problems.front();
    const std::string block = first.block ? "fluid_blocks[" + std::to_string(*first.block) + "]" : "";
    return {first.status.code(), block + first.field + ": " + first.status.message()};
  }
  return {};
}

double speedOfSound(const WorldDescription& d) {
  if (d.model == Model::literal && d.literal.stiffness) return std::sqrt(*d.literal.stiffness);
  const double g = d.effects.gravity ? d.effects.gravity->acceleration.norm() : 0.0;
  double speed =
      std::max(d.compressibility.design_speed, std::sqrt(2.0 * g * std::max(0.0, d.compressibility.max_fall_or_depth)));
  for (const WoundDescription& wound : d.wounds) {
    if (const auto* drive = std::get_if<PressureDriveSettings>(&wound.drive)) {
      speed = std::max(speed, std::sqrt(2.0 * std::max(0.0, drive->inlet_pressure) / d.rest_density));
    }
  }
  return d.compressibility.mach_factor * speed;
}

}  // namespace bleedsim::sph
