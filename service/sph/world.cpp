#include "service/sph/world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "service/sph/effects/effect_list.h"
#include "service/sph/effects/literal_list.h"
#include "service/sph/effects/platelets.h"
#include "service/sph/effects/rheology.h"
#include "service/sph/memory_need.h"
#include "service/sph/model_rules.h"
#include "service/sph/seeding.h"
#include "service/sph/world_checks.h"
#include "service/sph/world_core.h"
#include "service/sph/world_setup.h"

namespace bleedsim::sph {
namespace {

constexpr std::uint32_t kMostParticles = 2'000'000;
constexpr int kMostThreads = 64;
constexpr std::uint32_t kMostForceSources = 65'536;

constexpr std::array<std::string_view, static_cast<std::size_t>(Stage::count)> kStageNames{
    "emit", "move", "neighbors", "tissue", "density", "force", "body", "integrate"};
constexpr std::array<std::string_view, static_cast<std::size_t>(Counter::count)> kCounterNames{
    "speed_clamped",     "acceleration_clamped", "tissue_projected",      "left_domain",    "emission_refused",
    "inlet_withdrawn",   "neighbor_overflow",    "force_without_fluid",   "force_expired",  "viscosity_unsolved",
    "coincident_parted", "step_retried",         "infinite_force_capped", "particle_frozen"};

Status invalid(std::string message) { return {StatusCode::invalid_argument, std::move(message)}; }

Status checkEffects(const EffectSettings& effects) {
  if (effects.gravity && !effects.gravity->acceleration.allFinite()) return invalid("gravity must be three finite numbers");
  if (effects.pressure && !std::isfinite(effects.pressure->background_pressure)) {
    return invalid("the background pressure must be finite");
  }
  if (effects.viscosity && !isFiniteNotNegative(effects.viscosity->viscosity)) {
    return invalid("viscosity must be finite and not negative");
  }
  if (const auto& tension = effects.surface_tension) {
    if (!isFiniteNotNegative(tension->coefficient)) return invalid("the surface tension must be finite and not negative");
    if (!(tension->normal_cutoff > 0.0) || !std::isfinite(tension->normal_cutoff)) {
      return invalid("the cut-off of surface normals must be finite and greater than 0");
    }
    if (tension->contact_angle && !(*tension->contact_angle >= 0.0 && *tension->contact_angle <= std::numbers::pi)) {
      return invalid("the contact angle must be 0 to pi rad");
    }
  }
  if (effects.adhesion && !isFiniteNotNegative(effects.adhesion->acceleration)) {
    return invalid("adhesion must be finite and not negative");
  }
  if (effects.viscosity) {
    if (Status status = checkRheology(*effects.viscosity); !status.ok()) return status;
  }
  if (effects.platelets) {
    if (Status status = checkPlatelets(*effects.platelets); !status.ok()) return status;
    if (effects.viscosity && !(effects.viscosity->viscosity > 0.0)) {
      return invalid("platelets thicken blood: its viscosity must be greater than 0 Pa s");
    }
  }
  if (effects.applied_force && effects.applied_force->max_sources > kMostForceSources) {
    return invalid("applied_force.max_sources is " + std::to_string(effects.applied_force->max_sources) + "; use at most " +
                   std::to_string(kMostForceSources));
  }
  return {};
}

/// What the arrays and the grid need; the scene layer gives the finer messages.
Status checkDescription(const WorldDescription& d, const WorldOptions& options) {
  if (options.threads < 1 || options.threads > kMostThreads) {
    return invalid("threads is " + std::to_string(options.threads) + "; use 1 to " + std::to_string(kMostThreads));
  }
  const auto& periodic = d.domain.periodic;
  if (options.complete_search && (periodic[0] || periodic[1] || periodic[2])) {
    return invalid("a complete search needs a domain without periodic sides");
  }
  if (d.capacity < 1 || d.capacity > kMostParticles) {
    return invalid("capacity is " + std::to_string(d.capacity) + " particles; use 1 to " + std::to_string(kMostParticles));
  }
  if (!(d.spacing > 0.0) || !std::isfinite(d.spacing)) return invalid("the particle spacing must be greater than 0 m");
  if (!(d.support_ratio >= 1.5) || !(d.support_ratio <= 3.5)) return invalid("the support ratio h/dx must be 1.5 to 3.5");
  if (!(d.rest_density > 0.0) || !std::isfinite(d.rest_density)) return invalid("the rest density must be greater than 0 kg/m^3");
  if (!(d.max_dt > 0.0)) return invalid("the largest time step must be greater than 0 s");
  if (!isFiniteNotNegative(d.compressibility.max_fall_or_depth)) {
    return invalid("the largest fall or depth must be finite and not negative");
  }
  if (d.kernel != KernelType::wendland_c2 && d.kernel != KernelType::cubic_spline) {
    return invalid("the sound model's kernel must be Wendland C2 or the cubic spline");
  }
  if (Status status = checkEffects(d.effects); !status.ok()) return status;
  if (Status status = checkModel(d); !status.ok()) return status;
  if (Status status = checkEffectSet(d); !status.ok()) return status;
  const double h = d.supportRadius();
  const double c0 = options.speed_of_sound.value_or(speedOfSound(d));
  if (!(c0 > 0.0) || !std::isfinite(c0)) return invalid("the speed of sound must be greater than 0 m/s: set a design speed");
  for (Eigen::Index a = 0; a < 3; ++a) {
    const double length = d.domain.upper[a] - d.domain.lower[a];
    if (!(length > 0.0) || !std::isfinite(length)) return invalid("the domain's upper corner must lie above its lower corner");
    const double shortest = 3.0 * h * radiusBounds(d).largest;
    if (d.domain.periodic[static_cast<std::size_t>(a)] && length < shortest) {
      return invalid("a periodic side must measure at least three of the largest support radii, " + std::to_string(shortest) +
                     " m");
    }
  }
  if (const double cells = gridCells(d.domain, h); cells > kMostCells) {
    return invalid("the domain holds " + std::to_string(cells) +
                   " cells of one support radius, at most 16777216 are possible; use a "
                   "smaller domain or a larger spacing");
  }
  std::uint64_t seeded = 0;
  for (const FluidBlock& block : d.fluid_blocks) {
    if (Status status = checkBlock(block, d.effects); !status.ok()) return status;
    const auto counts = blockLattice(block, d.spacing);
    std::uint64_t particles = 1;  // bounded after every factor: the product of three could overflow
    for (const std::uint64_t count : counts)
      particles = std::min<std::uint64_t>(particles * count, std::uint64_t{kMostParticles} + 1);
    seeded = std::min<std::uint64_t>(seeded + particles, std::uint64_t{kMostParticles} + 1);
  }
  if (seeded > d.capacity) {
    return {StatusCode::capacity, "the fluid blocks hold " + std::to_string(seeded) + " particles, the capacity is " +
                                      std::to_string(d.capacity) + "; raise domain.capacity or the spacing"};
  }
  return {};
}

template <class Real>
Result<std::unique_ptr<World>> build(const WorldDescription& d, const WorldOptions& options, SimdTarget target,
                                     const WorldTables<Real>& tables) {
  const SmoothingKernel kernel = d.densityKernel();
  const RestLattice lattice = calibrateRestLattice(kernel, d.spacing, d.rest_density);
  Result<TissueField<Real>> tissue = TissueField<Real>::create(d.tissue, {.kernel = kernel,
                                                                          .spacing = d.spacing,
                                                                          .particle_mass = lattice.particle_mass,
                                                                          .rest_density = d.rest_density,
                                                                          .radii = radiusBounds(d),
                                                                          .calibrates_radii = d.model == Model::sound});
  if (!tissue) return tissue.status();
  auto world = std::make_unique<WorldCore<Real>>(d, options, target, tables, lattice, std::move(*tissue));
  if (Status status = world->populate(); !status.ok()) return status;
  return std::unique_ptr<World>{std::move(world)};
}

}  // namespace

Result<std::unique_ptr<World>> createWorld(const WorldDescription& description, const WorldOptions& options) {
  if (Status status = checkDescription(description, options); !status.ok()) return status;
  if (Status status = checkMemory(description, options.threads, availableMemory()); !status.ok()) return status;
  const PassChoice choice = passChoice(description);
  if (options.precision == Precision::float64) {
    if (options.simd != SimdTarget::automatic && options.simd != SimdTarget::scalar) {
      return invalid("double precision is the reference and runs on the scalar target only; use scalar or auto");
    }
    return build<double>(description, options, SimdTarget::scalar,
                         {referencePasses(choice), referenceSweeps(sweepChoice(description))});
  }
  const SimdTarget target = options.simd == SimdTarget::automatic ? availableSimdTargets().front() : options.simd;
  const PassTable<float>* table = findPasses(target, choice);
  if (table == nullptr) {
    std::string names;
    for (const SimdTarget available : availableSimdTargets())
      names += (names.empty() ? "" : ", ") + std::string{simdTargetName(available)};
    return Status{StatusCode::unsupported, "this machine or build lacks the SIMD target '" + std::string{simdTargetName(target)} +
                                               "'; available: " + names};
  }
  return build<float>(description, options, target, {*table, *findSweeps(target, sweepChoice(description))});
}

void FrameBuffer::reserve(std::uint32_t capacity, std::uint32_t attributes_wanted) {
  const std::size_t n = capacity;
  position.resize(3 * n);
  id.resize(n);
  velocity.resize(attributes_wanted & kFrameVelocity ? 3 * n : 0);
  density.resize(attributes_wanted & kFrameDensity ? n : 0);
  viscosity.resize(attributes_wanted & kFrameViscosity ? n : 0);
  platelet.resize(attributes_wanted & kFramePlatelet ? n : 0);
  radius.resize(attributes_wanted & kFrameRadius ? n : 0);
}

std::string_view stageName(Stage stage) { return kStageNames[static_cast<std::size_t>(stage)]; }
std::string_view counterName(Counter counter) { return kCounterNames[static_cast<std::size_t>(counter)]; }

std::span<const EffectInfo> effectCatalog() {
  static constexpr auto kCatalog = [] {
    std::array<EffectInfo, kEffects.size() + kEffectParts.size()> catalog{};
    for (std::size_t i = 0; i < kEffects.size(); ++i) {
      catalog[i] = kEffects[i].info;
      catalog[i].literal = literalText(catalog[i].name);
    }
    for (std::size_t i = 0; i < kEffectParts.size(); ++i) catalog[kEffects.size() + i] = kEffectParts[i].info;
    return catalog;
  }();
  return kCatalog;
}

bool effectEnabled(const WorldDescription& description, std::string_view name) {
  for (const EffectRow& row : kEffects) {
    if (row.info.name == name) return row.slot.present(description.effects);
  }
  for (const PartRow& row : kEffectParts) {
    if (row.info.name == name) return row.acts(description);
  }
  return false;
}

}  // namespace bleedsim::sph
