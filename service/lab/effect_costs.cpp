#include "service/lab/effect_costs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>

#include "service/sph/effects/effect_list.h"

namespace bleedsim::lab {
namespace {

constexpr int kDepth = 16;        // spacings
constexpr int kWarmUpSteps = 20;  // until radii, viscosities and normals are those of the pool
constexpr double kAnyStep = std::numeric_limits<double>::infinity();  // the longest stable one: an implicit solve has real work

/// What an effect cannot be without.
struct Need {
  std::string_view effect, needs;
};
constexpr std::array kNeeds{Need{"platelets", "viscosity"}};

double wallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The scene's fluid in a body of about `particles`, with all of its effects.
sph::WorldDescription poolOf(const sph::WorldDescription& scene, std::uint32_t particles) {
  const int depth = scene.planar ? 1 : kDepth;
  const double across = std::max(4.0, std::round(std::sqrt(static_cast<double>(particles) / depth)));
  const sph::Vec3 size = scene.spacing * sph::Vec3{across, across, static_cast<double>(depth)};
  sph::WorldDescription pool = scene;
  pool.domain = {};
  pool.domain.lower = sph::Vec3::Constant(-10.0 * scene.spacing);
  pool.domain.upper = size + sph::Vec3::Constant(10.0 * scene.spacing);
  pool.capacity = static_cast<std::uint32_t>(across * across) * static_cast<std::uint32_t>(depth);
  pool.compressibility.max_fall_or_depth = std::max(scene.compressibility.max_fall_or_depth, size.z());
  if (pool.effects.pressure) pool.effects.pressure->background_pressure = 0.0;  // the free surface would burst
  pool.wounds.clear();
  pool.tissue.clear();
  if (!scene.planar) {
    sph::BoxShape box;
    box.upper = size;
    box.open_top = true;
    pool.tissue = {{.name = "box", .shape = box, .slip = 0.0}};
  }
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
    for (int k = 0; k < kWarmUpSteps; ++k) {
      if (Status status = variant->world_->step(kAnyStep); !status.ok()) return status;
    }
    sph::WorldStats stats;
    variant->world_->collectStats(stats);
    variant->dt_ = stats.dt;
    return variant;
  }

  explicit Variant(std::unique_ptr<sph::World> world) : world_{std::move(world)} {}

  Status turn(const CostOptions& options) {
    const auto clock = options.threads == 1 ? threadSeconds : wallSeconds;
    const double start = clock();
    for (int k = 0; k < options.steps; ++k) {
      if (Status status = world_->step(kAnyStep); !status.ok()) return status;
    }
    microseconds_.push_back(1e6 * (clock() - start) / options.steps / std::max(1U, world_->particleCount()));
    return {};
  }

  VariantCost cost() const {
    const double capacity = world_->description().capacity;
    const sph::MemoryUse memory = world_->memory();
    VariantCost cost;
    cost.microseconds = medianOf(microseconds_);
    cost.bytes = static_cast<double>(memory.particles + memory.passes + memory.grid + memory.tissue + memory.effects) / capacity;
    cost.list_bytes = static_cast<double>(memory.lists) / capacity;
    cost.dt = dt_;
    return cost;
  }

  const std::vector<double>& microseconds() const { return microseconds_; }
  const sph::World& world() const { return *world_; }

 private:
  std::unique_ptr<sph::World> world_;
  std::vector<double> microseconds_;  // per particle and step, of each turn
  double dt_ = 0.0;                   // that the effects ask for, s
};

/// `larger` less `smaller`, turn by turn; `run` is which of them the difference is told of.
CostDifference differenceOf(const Variant& larger, const Variant& smaller, const Variant& run) {
  std::vector<double> differences;
  for (std::size_t k = 0; k < larger.microseconds().size(); ++k)
    differences.push_back(larger.microseconds()[k] - smaller.microseconds()[k]);
  CostDifference difference;
  difference.cost = run.cost();
  difference.microseconds = medianOf(std::move(differences));
  difference.bytes = larger.cost().bytes - smaller.cost().bytes;
  return difference;
}

struct Plan {
  const Variant* beside = nullptr;
  const Variant* alone = nullptr;
  const Variant* without = nullptr;
  std::vector<std::string> needed;   // by the effect
  std::vector<std::string> needing;  // it, in the scene
};

/// All variants of one scene.
class Costs {
 public:
  Costs(const sph::WorldDescription& scene, const CostOptions& options)
      : pool_{poolOf(scene, options.particles)}, options_{options} {}

  Status prepare(const std::function<void(double)>& progress) {
    const sph::EffectSettings none;
    if (Status status = add(none, nothing_); !status.ok()) return status;
    if (Status status = add(pool_.effects, whole_); !status.ok()) return status;
    for (const sph::EffectRow& row : sph::kEffects) {
      EffectCost cost;
      cost.name = row.info.name;
      cost.in_scene = row.slot.present(pool_.effects);
      Plan plan = planOf(cost.name);
      sph::EffectSettings alone;
      for (const sph::EffectRow& other : sph::kEffects) {
        if (std::find(plan.needed.begin(), plan.needed.end(), other.info.name) != plan.needed.end())
          other.slot.add(alone, pool_.effects);
      }
      row.slot.add(alone, pool_.effects);
      if (Status status = add(alone, plan.alone); !status.ok()) cost.refusal = status.message();
      if (cost.in_scene) {
        sph::EffectSettings without = pool_.effects;
        row.slot.remove(without);
        for (const sph::EffectRow& other : sph::kEffects) {
          if (std::find(plan.needing.begin(), plan.needing.end(), other.info.name) != plan.needing.end())
            other.slot.remove(without);
        }
        if (Status status = add(without, plan.without); !status.ok()) cost.refusal = status.message();
      }
      effects_.push_back(std::move(cost));
      plans_.push_back(std::move(plan));
      progress(static_cast<double>(plans_.size()) / static_cast<double>(sph::kEffects.size()));
    }
    return {};
  }

  Status turn() {
    for (const std::unique_ptr<Variant>& variant : variants_) {
      if (Status status = variant->turn(options_); !status.ok()) return status;
    }
    ++turns_;
    return {};
  }

  int turns() const { return turns_; }

  EffectCosts result() && {
    EffectCosts costs;
    costs.particles = nothing_->world().particleCount();
    costs.simd = sph::simdTargetName(nothing_->world().simdTarget());
    costs.turns = turns_;
    costs.cpu_time = options_.threads == 1;
    costs.nothing = nothing_->cost();
    costs.scene = whole_->cost();
    for (std::size_t k = 0; k < plans_.size(); ++k) {
      const Plan& plan = plans_[k];
      if (plan.alone != nullptr && plan.beside != nullptr) {
        effects_[k].alone = differenceOf(*plan.alone, *plan.beside, *plan.alone);
        effects_[k].alone->others = plan.needed;
      }
      if (plan.without != nullptr) {
        effects_[k].without = differenceOf(*whole_, *plan.without, *plan.without);
        effects_[k].without->others = plan.needing;
      }
    }
    costs.effects = std::move(effects_);
    return costs;
  }

 private:
  /// Without its own variants; those of the effects before it are there.
  Plan planOf(std::string_view effect) const {
    Plan plan;
    plan.beside = nothing_;
    for (const Need& need : kNeeds) {
      for (std::size_t k = 0; need.effect == effect && k < plans_.size(); ++k) {
        if (effects_[k].name != need.needs) continue;
        plan.beside = plans_[k].alone;
        plan.needed.emplace_back(need.needs);
      }
      for (const sph::EffectRow& row : sph::kEffects) {
        const bool needing = need.needs == effect && row.info.name == need.effect;
        if (needing && row.slot.present(pool_.effects)) plan.needing.emplace_back(row.info.name);
      }
    }
    return plan;
  }

  Status add(const sph::EffectSettings& effects, const Variant*& made) {
    auto variant = Variant::create(pool_, effects, options_);
    if (!variant) return variant.status();
    made = variant->get();
    variants_.push_back(std::move(*variant));
    return {};
  }

  sph::WorldDescription pool_;
  CostOptions options_;
  std::vector<std::unique_ptr<Variant>> variants_;
  const Variant* nothing_ = nullptr;
  const Variant* whole_ = nullptr;
  std::vector<Plan> plans_;
  std::vector<EffectCost> effects_;
  int turns_ = 0;
};

}  // namespace

Result<EffectCosts> measureEffectCosts(const sph::WorldDescription& scene, const CostOptions& options,
                                       const std::function<void(double)>& progress) {
  const double start = wallSeconds();
  Costs costs{scene, options};
  if (Status status = costs.prepare([&](double part) { progress(0.2 * part); }); !status.ok()) return status;
  for (double spent = 0.0; costs.turns() < kLeastTurns || spent < options.seconds; spent = wallSeconds() - start) {
    if (Status status = costs.turn(); !status.ok()) return status;
    progress(0.2 + 0.8 * std::min(1.0, (wallSeconds() - start) / options.seconds));
  }
  progress(1.0);
  return std::move(costs).result();
}

}  // namespace bleedsim::lab
