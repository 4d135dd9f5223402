#include "service/sph/world_checks.h"

#include <string>

#include "service/sph/effects/rheology.h"
#include "service/sph/world_setup.h"

namespace bleedsim::sph {
namespace {

constexpr double kSmallestRadius = 0.5;
constexpr double kLargestRadius = 1.5;
constexpr double kMostStrength = 100.0;
constexpr double kLeastContactDistance = 0.1;
constexpr int kMostPower = 16;
constexpr double kMostDamping = 10.0;

Status invalid(std::string message) { return {StatusCode::invalid_argument, std::move(message)}; }

/// Written so that NaN lies outside.
bool within(double value, double lowest, double highest) { return value >= lowest && value <= highest; }

Status checkCoreRadius(const CoreRadiusSettings& settings) {
  if (!within(settings.smallest, kSmallestRadius, 1.0)) {
    return invalid("core_radius.smallest is " + std::to_string(settings.smallest) + "; use 0.5 to 1 of the support radius");
  }
  if (!within(settings.largest, 1.0, kLargestRadius)) {
    return invalid("core_radius.largest is " + std::to_string(settings.largest) + "; use 1 to 1.5 of the support radius");
  }
  if (!(settings.relaxation > 0.0) || !(settings.relaxation <= 1.0)) {
    return invalid("core_radius.relaxation is " + std::to_string(settings.relaxation) + "; use more than 0, at most 1");
  }
  return {};
}

Status checkRepulsion(const RepulsionSettings& settings) {
  if (!within(settings.strength, 0.0, kMostStrength)) {
    return invalid("repulsion.strength is " + std::to_string(settings.strength) +
                   "; use 0 to 100, where 1.5 is as stiff as the blood");
  }
  if (!within(settings.contact_distance, kLeastContactDistance, 1.0)) {
    return invalid("repulsion.contact_distance is " + std::to_string(settings.contact_distance) +
                   "; use 0.1 to 1 spacings, beyond which blood at rest would expand");
  }
  if (settings.power_2 < 1 || settings.power_1 <= settings.power_2 || settings.power_1 > kMostPower) {
    return invalid("repulsion.power_1 and power_2 are " + std::to_string(settings.power_1) + " and " +
                   std::to_string(settings.power_2) + "; use whole numbers with 16 >= power_1 > power_2 >= 1");
  }
  if (!within(settings.damping, 0.0, kMostDamping)) {
    return invalid("repulsion.damping is " + std::to_string(settings.damping) + "; use 0 to 10");
  }
  return {};
}

/// Name of an enabled effect that the cubic spline has no compiled pass for; empty if there is none.
std::string beyondTheSpline(const EffectSettings& effects) {
  if (effects.surface_tension) return "surface_tension";
  if (effects.platelets) return "platelets";
  if (effects.core_radius) return "core_radius";
  if (effects.repulsion) return "repulsion";
  if (effects.viscosity && effects.viscosity->solve == ViscositySolve::implicit) return "viscosity solved implicitly";
  if (viscosityThins(effects)) { return "viscosity that follows the shear rate"; }
  return {};
}

}  // namespace

Status checkBlockViscosity(const FluidBlock& block, const EffectSettings& effects) {
  if (block.viscosity && !isFiniteNotNegative(*block.viscosity)) {
    return invalid("a fluid block's viscosity must be finite and not negative");
  }
  if (block.viscosity && *block.viscosity == 0.0 && viscosityChanges(effects)) {
    return invalid("a fluid block's viscosity must be greater than 0 where platelets or a rheology act");
  }
  return {};
}

Status checkBlock(const FluidBlock& block, const EffectSettings& effects) {
  if (!block.lower.allFinite() || !block.upper.allFinite()) return invalid("a fluid block's corners must be finite");
  if (!block.velocity.allFinite()) return invalid("a fluid block's velocity must be finite");
  if (!isFiniteNotNegative(block.jitter)) return invalid("a fluid block's jitter must be finite and not negative");
  if (Status status = checkBlockViscosity(block, effects); !status.ok()) return status;
  if (block.platelet && !(*block.platelet >= 0.0 && *block.platelet <= 1.0)) {
    return invalid("a fluid block's platelets must be between 0 and 1");
  }
  return {};
}

double gridCells(const Domain& domain, double support_radius) {
  const Vec3 sides = (domain.upper - domain.lower) / support_radius;
  return (sides.array() + 2.0 * kThroatMargin).prod();
}

Status checkEffectSet(const WorldDescription& description) {
  const EffectSettings& effects = description.effects;
  if (effects.core_radius) {
    if (Status status = checkCoreRadius(*effects.core_radius); !status.ok()) return status;
  }
  if (effects.repulsion) {
    if (Status status = checkRepulsion(*effects.repulsion); !status.ok()) return status;
  }
  if (description.kernel == KernelType::cubic_spline) {
    if (const std::string effect = beyondTheSpline(effects); !effect.empty()) {
      return {StatusCode::unsupported,
              "the cubic spline knows pressure and explicit Newtonian viscosity only, the scene also has " + effect +
                  ": use the kernel wendland_c2, or leave that out"};
    }
  }
  return {};
}

}  // namespace bleedsim::sph
