#include <array>
#include <cmath>
#include <fmt/format.h>

#include "service/scene/convert.h"
#include "service/scene/validate.h"
#include "service/sph/world_checks.h"

namespace bleedsim::scene {
namespace {

struct Side {
  char axis;
  double length;  ///< m
  bool periodic;
};

std::array<Side, 3> sidesOf(const Domain& domain) {
  return {{{'x', domain.upper_m().x() - domain.lower_m().x(), domain.periodic_x()},
           {'y', domain.upper_m().y() - domain.lower_m().y(), domain.periodic_y()},
           {'z', domain.upper_m().z() - domain.lower_m().z(), domain.periodic_z()}}};
}

/// `support` is the support radius, m; 0 if it is not known because the resolution is wrong.
void validateSides(const Domain& domain, double support, ProblemList& problems) {
  for (const Side& side : sidesOf(domain)) {
    if (side.length > kMaxDomainSide) {
      problems.add("domain", fmt::format("the {} side measures {:.6g} m, allowed are at most {} m", side.axis, side.length,
                                         kMaxDomainSide));
    }
    if (support <= 0.0) continue;
    if (side.periodic && side.length < kMinPeriodicSide * support) {
      problems.add(
          fmt::format("domain.periodic_{}", side.axis),
          fmt::format(
              "the side measures {:.6g} m, a periodic one needs at least {:.6g} m, three support radii; widen the domain or "
              "lower resolution.spacing_m",
              side.length, kMinPeriodicSide * support));
    }
  }
  if (support <= 0.0) return;
  if (const double cells = sph::gridCells(convertDomain(domain), support); cells > sph::kMostCells) {
    problems.add("domain",
                 fmt::format("holds {:.0f} cells of one support radius ({:.6g} m), allowed are at most {}; shrink the domain or "
                             "raise resolution.spacing_m",
                             cells, support, sph::kMostCells));
  }
}

/// The support radius, m, or 0.
double validateResolution(const Scene& scene, ProblemList& problems) {
  if (!scene.has_resolution()) {
    problems.add("resolution", "is required: give resolution { spacing_m: ... }");
    return 0.0;
  }
  const std::size_t before = problems.count();
  const Resolution& resolution = scene.resolution();
  problems.requireInRange("resolution.spacing_m", resolution.spacing_m(), kSpacing);
  problems.requireInRange("resolution.support_ratio", resolution.support_ratio(), kSupportRatio);
  if (!Resolution::Kernel_IsValid(resolution.kernel())) {
    problems.add("resolution.kernel",
                 fmt::format("value {} is unknown, known are WENDLAND_C2, CUBIC_SPLINE", static_cast<int>(resolution.kernel())));
  }
  const double support = resolution.spacing_m() * resolution.support_ratio();
  return problems.count() == before && std::isfinite(support) ? support : 0.0;
}

void validateCompressibility(const Scene& scene, ProblemList& problems) {
  if (!scene.has_compressibility()) {
    problems.add("compressibility", "is required: give compressibility { design_speed_m_per_s: ... }");
    return;
  }
  const Compressibility& settings = scene.compressibility();
  problems.requireInRange("compressibility.mach_factor", settings.mach_factor(), kMachFactor);
  problems.requireInRange("compressibility.design_speed_m_per_s", settings.design_speed_m_per_s(), kDesignSpeed);
  problems.requireInRange("compressibility.max_fall_or_depth_m", settings.max_fall_or_depth_m(), kMaxFallOrDepth);
}

}  // namespace

namespace {

void validateLiteral(const Literal& literal, ProblemList& problems) {
  if (!Literal::Pressure_IsValid(literal.pressure())) {
    problems.add("literal.pressure",
                 fmt::format("value {} is unknown, known are SYMMETRIC, VARIATIONAL", static_cast<int>(literal.pressure())));
  }
  const auto require = [&problems](bool given, const char* field, double value, const Range& range) {
    if (given) problems.requireInRange(std::string{"literal."} + field, value, range);
  };
  require(literal.has_stiffness_m2_per_s2(), "stiffness_m2_per_s2", literal.stiffness_m2_per_s2(), kLiteralStiffness);
  require(true, "tension_n_per_m", literal.tension_n_per_m(), kLiteralTension);
  require(true, "normal_cutoff", literal.normal_cutoff(), kNormalCutoff);
  require(true, "thickening_pa_s", literal.thickening_pa_s(), kShearViscosity);
  require(literal.has_thickening_exponent(), "thickening_exponent", literal.thickening_exponent(), kLiteralExponent);
  require(true, "platelet_diffusivity_m2_per_s", literal.platelet_diffusivity_m2_per_s(), kDiffusivity);
  require(literal.has_repulsion_n_m2(), "repulsion_n_m2", literal.repulsion_n_m2(), kLiteralRepulsion);
  require(true, "power_1", literal.power_1(), kRepulsionPower);
  require(true, "power_2", literal.power_2(), kRepulsionPower);
  require(true, "contact_radius", literal.contact_radius(), kLiteralContact);
  if (literal.power_1() <= literal.power_2()) {
    problems.add("literal.power_1",
                 fmt::format("value {} must be above power_2, {}: contacts would attract", literal.power_1(), literal.power_2()));
  }
}

}  // namespace

void validateDomain(const Scene& scene, ProblemList& problems) {
  const double support = validateResolution(scene, problems);
  if (scene.has_domain()) {
    const Domain& domain = scene.domain();
    problems.requireInRange("domain.capacity", domain.capacity(), kCapacity);
    if (requireBox("domain", domain.has_lower_m(), domain.lower_m(), domain.has_upper_m(), domain.upper_m(), problems)) {
      validateSides(domain, support, problems);
    }
  } else {
    problems.add("domain", "is required: give domain { lower_m {...} upper_m {...} capacity: ... }");
  }
  problems.requireInRange("fluid.density_kg_per_m3", scene.fluid().density_kg_per_m3(), kDensity);
  validateCompressibility(scene, problems);
  if (scene.has_max_dt_s()) problems.requireInRange("max_dt_s", scene.max_dt_s(), kMaxDt);
  if (scene.has_horizon_s()) problems.requireInRange("horizon_s", scene.horizon_s(), kHorizon);
  if (!Scene::Model_IsValid(scene.model())) {
    problems.add("model", fmt::format("value {} is unknown, known are SOUND, LITERAL", static_cast<int>(scene.model())));
  } else if (scene.model() == Scene::LITERAL) {
    validateLiteral(scene.literal(), problems);
  } else if (scene.has_literal()) {
    problems.add("literal", "holds numbers of the paper's equations; set model LITERAL or leave it out");
  }
}

}  // namespace bleedsim::scene
