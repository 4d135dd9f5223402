#include "service/scene/auto_effects.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <variant>

#include "service/scene/feature_size.h"
#include "service/sph/world_setup.h"

namespace bleedsim::scene {
namespace {

constexpr double kCapillaryLengths = 3.0;
constexpr double kShareOfClotting = 0.01;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct TissueScale {
  double operator()(const sph::PlaneShape&) const { return kInfinity; }
  double operator()(const sph::BoxShape& box) const { return (box.upper - box.lower).minCoeff(); }
  double operator()(const sph::BowlShape& bowl) const { return std::min(bowl.sphere_radius, bowl.depth); }
};

struct Feature {
  double size = kInfinity;  ///< m
  std::string what;

  void take(double other, const std::string& name) {
    if (other >= size) return;
    size = other;
    what = name;
  }
};

Feature smallestFeature(const sph::WorldDescription& world, double narrowest_wound) {
  Feature smallest;
  for (std::size_t i = 0; i < world.wounds.size(); ++i) {
    smallest.take(patchWidth(world.wounds[i].shape), fmt::format("wounds[{}]", i));
  }
  for (std::size_t i = 0; i < world.fluid_blocks.size(); ++i) {
    smallest.take((world.fluid_blocks[i].upper - world.fluid_blocks[i].lower).minCoeff(), fmt::format("fluid_blocks[{}]", i));
  }
  for (std::size_t i = 0; i < world.tissue.size(); ++i) {
    smallest.take(std::visit(TissueScale{}, world.tissue[i].shape), fmt::format("tissue[{}]", i));
  }
  smallest.take(narrowest_wound, "a wound by command");
  return smallest;
}

/// Until P falls from `fresh` to 1/2 where blood touches tissue and air at rest, s. With y = 1/P the rate is linear:
/// dy/dt = s (c y - r), c = r + k_w + k_a; ln 99/r for fresh = 0.99 without tissue and air.
double clottingTime(const sph::PlateletSettings& p) {
  const double rate = p.activation_rate + p.wall_rate + p.air_rate;
  if (!(rate * p.clot_speedup > 0.0)) return kInfinity;
  if (!(p.fresh > 0.5)) return 0.0;
  const double rest = p.activation_rate / rate;
  const double fresh = 1.0 / p.fresh - rest;
  if (!(fresh > 0.0)) return kInfinity;  // P = 1 without tissue and air: nothing starts the reaction
  return std::log((2.0 - rest) / fresh) / (rate * p.clot_speedup);
}

}  // namespace

const std::vector<std::string>& autoNames() {
  static const std::vector<std::string> kNames{std::string{kAutoTension}, std::string{kAutoPlatelets},
                                               std::string{kAutoImplicit}};
  return kNames;
}

double tensionReach(const sph::WorldDescription& world) {
  const double g = world.effects.gravity ? world.effects.gravity->acceleration.norm() : 0.0;
  if (!(g > 0.0)) return kInfinity;
  return kCapillaryLengths * std::sqrt(world.effects.surface_tension->coefficient / (world.rest_density * g));
}

AutoDecision decideTension(const sph::WorldDescription& world, double narrowest_wound) {
  AutoDecision decision{std::string{kAutoTension}, true, {}};
  const double reach = tensionReach(world);
  if (!std::isfinite(reach)) {
    decision.reason = "without gravity nothing outweighs it";
    return decision;
  }
  const Feature smallest = smallestFeature(world, narrowest_wound);
  if (!std::isfinite(smallest.size)) {
    decision.reason = "the scene has no wound, block or tissue to judge it by";
    return decision;
  }
  decision.enabled = smallest.size <= reach;
  decision.reason = fmt::format("the smallest feature, {} of {:.3g} mm, is {} {:g} capillary lengths, {:.3g} mm", smallest.what,
                                smallest.size * 1e3, decision.enabled ? "within" : "above", kCapillaryLengths, reach * 1e3);
  return decision;
}

AutoDecision decidePlatelets(const sph::WorldDescription& world, double horizon) {
  const double clotting = clottingTime(*world.effects.platelets);
  AutoDecision decision{std::string{kAutoPlatelets}, horizon >= kShareOfClotting * clotting, {}};
  decision.reason = fmt::format("the horizon, {:.3g} s, is {} {:g} % of the shortest clotting time, {:.3g} s", horizon,
                                decision.enabled ? "at least" : "below", kShareOfClotting * 100.0, clotting);
  return decision;
}

AutoDecision decideImplicitViscosity(const sph::WorldDescription& world, double speed_of_sound) {
  AutoDecision decision{std::string{kAutoImplicit}, false, {}};
  const double viscosity = sph::largestPossibleViscosity(world);
  const double explicit_limit = viscosity > 0.0 ? sph::diffusionLimit(world, viscosity / world.rest_density) : kInfinity;
  sph::TimeStepLimits limits = sph::timeStepLimits(world, speed_of_sound);
  limits.viscous = kInfinity;
  const double other = sph::stableTimeStep(limits, 0.0, 0.0, kInfinity);
  decision.enabled = explicit_limit < other;
  decision.reason = fmt::format("the explicit limit, {:.3g} ms, is {} the next one, {:.3g} ms", explicit_limit * 1e3,
                                decision.enabled ? "below" : "not below", other * 1e3);
  return decision;
}

std::vector<AutoDecision> applyAuto(const std::vector<std::string>& names, std::optional<double> horizon,
                                    const std::optional<Session>& session, sph::WorldDescription& world) {
  const auto named = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  std::vector<AutoDecision> decisions;
  if (named(kAutoTension) && world.effects.surface_tension) {
    decisions.push_back(decideTension(world, session.value_or(Session{}).narrowest_wound));
    if (!decisions.back().enabled) world.effects.surface_tension.reset();
  }
  if (named(kAutoPlatelets) && world.effects.platelets && horizon) {
    decisions.push_back(decidePlatelets(world, *horizon));
    if (!decisions.back().enabled) world.effects.platelets.reset();
  }
  // Last: the limits depend on what is left.
  if (named(kAutoImplicit) && world.effects.viscosity) {
    const double speed_of_sound = session ? session->speed_of_sound : sph::speedOfSound(world);
    decisions.push_back(decideImplicitViscosity(world, speed_of_sound));
    if (!decisions.back().enabled) world.effects.viscosity->solve = sph::ViscositySolve::explicit_;
  }
  return decisions;
}

}  // namespace bleedsim::scene
