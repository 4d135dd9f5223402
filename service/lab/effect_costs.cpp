#include "service/lab/effect_costs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "service/sph/effects/effect_list.h"

namespace bleedsim::lab {
namespace {

constexpr int kDepth = 16;        // spacings
constexpr int kWarmUpSteps = 20;  // until radii, viscosities and normals are those of the pool
constexpr double kAnyStep = std::numeric_limits<double>::infinity();
constexpr double kHeld = 1e-9;  // s: nothing moves

/// The scene's fluid and effects in a pool of about `particles`.
sph::WorldDescription poolOf(const sph::WorldDescription& scene, std::uint32_t particles) {
  const double across = std::max(4.0, std::round(std::sqrt(static_cast<double>(particles) / kDepth)));
  const sph::Vec3 size = scene.spacing * sph::Vec3{across, across, kDepth};
  sph::WorldDescription pool = scene;
  pool.domain = {};
  pool.domain.lower = sph::Vec3::Constant(-10.0 * scene.spacing);
  pool.domain.upper = size + sph::Vec3::Constant(10.0 * scene.spacing);
  pool.capacity = static_cast<std::uint32_t>(across * across * kDepth);
  pool.compressibility.max_fall_or_depth = std::max(scene.compressibility.max_fall_or_depth, size.z());
  pool.wounds.clear();
  sph::BoxShape box;
  box.upper = size;
  box.open_top = true;
  pool.tissue = {{.name = "box", .shape = box}};
  sph::FluidBlock block;
  block.upper = size;
  block.jitter = 0.15;  // blood in motion is no lattice
  pool.fluid_blocks = {block};
  return pool;
}

/// One set of effects, measured in turns.
class Variant {
 public:
  static Result<std::unique_ptr<Variant>> create(sph::WorldDescription pool, const sph::EffectSettings& effects,
                                                 const CostOptions& options) {
    pool.effects = effects;
    auto world = sph::createWorld(pool, {.threads = options.threads, .simd = options.simd});
    if (!world) return world.status();
    auto variant = std::make_unique<Variant>(std::move(*world));
    if (Status status = variant->world_->step(kAnyStep); !status.ok()) return status;
    sph::WorldStats stats;
    variant->world_->collectStats(stats);
    variant->dt_ = stats.dt;
    for (int k = 0; k < kWarmUpSteps; ++k) {
      if (Status status = variant->world_->step(kHeld); !status.ok()) return status;
    }
    return variant;
  }

  explicit Variant(std::unique_ptr<sph::World> world) : world_{std::move(world)} {}

  Status turn(int steps) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    for (int k = 0; k < steps; ++k) {
      if (Status status = world_->step(kHeld); !status.ok()) return status;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    seconds_per_step_.push_back(seconds / steps);
    return {};
  }

  VariantCost cost() const {
    std::vector<double> sorted = seconds_per_step_;
    std::sort(sorted.begin(), sorted.end());
    const double capacity = world_->description().capacity;
    const sph::MemoryUse memory = world_->memory();
    VariantCost cost;
    cost.microseconds = 1e6 * sorted[sorted.size() / 2] / std::max(1u, world_->particleCount());
    cost.bytes = static_cast<double>(memory.particles + memory.passes + memory.grid + memory.tissue + memory.effects) / capacity;
    cost.list_bytes = static_cast<double>(memory.lists) / capacity;
    cost.dt = dt_;
    return cost;
  }

  const sph::World& world() const { return *world_; }

 private:
  std::unique_ptr<sph::World> world_;
  std::vector<double> seconds_per_step_;
  double dt_ = 0.0;  // that the effects ask for, s
};

struct Measured {
  std::unique_ptr<Variant> alone;
  std::unique_ptr<Variant> without;
};

}  // namespace

Result<EffectCosts> measureEffectCosts(const sph::WorldDescription& scene, const CostOptions& options,
                                       const std::function<void(double)>& progress) {
  const sph::WorldDescription pool = poolOf(scene, options.particles);
  sph::EffectSettings base_effects;
  base_effects.gravity = scene.effects.gravity ? scene.effects.gravity : sph::GravitySettings{};
  base_effects.pressure = scene.effects.pressure ? scene.effects.pressure : sph::PressureSettings{};
  auto base = Variant::create(pool, base_effects, options);
  if (!base) return base.status();
  auto whole = Variant::create(pool, scene.effects, options);
  if (!whole) return whole.status();

  EffectCosts costs;
  std::vector<Measured> measured(sph::kEffects.size());
  std::vector<Variant*> turns{base->get(), whole->get()};
  for (std::size_t k = 0; k < sph::kEffects.size(); ++k) {
    const sph::EffectSlot& slot = sph::kEffects[k].slot;
    EffectCost cost;
    cost.name = sph::kEffects[k].info.name;
    cost.in_scene = slot.present(scene.effects);
    const auto measure = [&](const sph::EffectSettings& effects, std::unique_ptr<Variant>& variant) {
      auto created = Variant::create(pool, effects, options);
      if (!created) {
        cost.refusal = created.status().message();
        return;
      }
      variant = std::move(*created);
      turns.push_back(variant.get());
    };
    sph::EffectSettings alone = base_effects;
    if (!slot.present(base_effects)) {
      slot.add(alone, scene.effects);
      measure(alone, measured[k].alone);
    }
    if (cost.in_scene) {
      sph::EffectSettings without = scene.effects;
      slot.remove(without);
      measure(without, measured[k].without);
    }
    costs.effects.push_back(std::move(cost));
    progress(0.5 * static_cast<double>(k + 1) / static_cast<double>(sph::kEffects.size()));
  }
  for (int turn = 0; turn < options.turns; ++turn) {
    for (Variant* variant : turns) {
      if (Status status = variant->turn(options.steps); !status.ok()) return status;
    }
    progress(0.5 + 0.5 * (turn + 1) / options.turns);
  }
  costs.particles = (*base)->world().particleCount();
  costs.simd = sph::simdTargetName((*base)->world().simdTarget());
  costs.base = (*base)->cost();
  costs.scene = (*whole)->cost();
  for (std::size_t k = 0; k < measured.size(); ++k) {
    if (measured[k].alone) costs.effects[k].alone = measured[k].alone->cost();
    if (measured[k].without) costs.effects[k].without = measured[k].without->cost();
  }
  return costs;
}

}  // namespace bleedsim::lab
