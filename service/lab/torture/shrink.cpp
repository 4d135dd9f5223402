#include <algorithm>

#include "service/lab/torture/torture.h"

namespace bleedsim::lab {
namespace {

using scene::Effects;

/// Tries smaller plans until none of them fails.
class Shrinker {
 public:
  Shrinker(TorturePlan plan, const std::function<bool(const TorturePlan&)>& fails, int tries)
      : plan_{std::move(plan)}, fails_{fails}, tries_{tries} {}

  TorturePlan shrink() {
    for (bool smaller = true; smaller && tries_ > 0;) smaller = turn();
    return std::move(plan_);
  }

 private:
  bool turn() {
    bool smaller = false;
    smaller |= halveSteps();
    smaller |= dropEach([](TorturePlan& plan) { return static_cast<int>(plan.commands.size()); },
                        [](TorturePlan& plan, int k) { plan.commands.erase(plan.commands.begin() + k); });
    smaller |= dropEach([](TorturePlan& plan) { return static_cast<int>(plan.changes.size()); },
                        [](TorturePlan& plan, int k) { plan.changes.erase(plan.changes.begin() + k); });
    smaller |= dropEach([](TorturePlan& plan) { return static_cast<int>(plan.limits.size()); },
                        [](TorturePlan& plan, int k) { plan.limits.erase(plan.limits.begin() + k); });
    smaller |= dropEffects();
    smaller |= dropEach([](TorturePlan& plan) { return plan.scene.wounds_size(); },
                        [](TorturePlan& plan, int k) { plan.scene.mutable_wounds()->DeleteSubrange(k, 1); });
    smaller |= dropEach([](TorturePlan& plan) { return plan.scene.fluid_blocks_size(); },
                        [](TorturePlan& plan, int k) { plan.scene.mutable_fluid_blocks()->DeleteSubrange(k, 1); });
    smaller |= dropEach([](TorturePlan& plan) { return plan.scene.tissue_size(); },
                        [](TorturePlan& plan, int k) { plan.scene.mutable_tissue()->DeleteSubrange(k, 1); });
    smaller |= halveBlocks();
    smaller |= dropDetails();
    return smaller;
  }

  template <class Change>
  bool attempt(const Change& change) {
    if (tries_ <= 0) return false;
    TorturePlan candidate = plan_;
    change(candidate);
    --tries_;
    if (!fails_(candidate)) return false;
    plan_ = std::move(candidate);
    return true;
  }

  /// Whatever can be dropped, one at a time, from the end.
  template <class Count, class Drop>
  bool dropEach(const Count& count, const Drop& drop) {
    bool smaller = false;
    for (int k = count(plan_) - 1; k >= 0; --k) smaller |= attempt([&](TorturePlan& plan) { drop(plan, k); });
    return smaller;
  }

  bool halveSteps() {
    bool smaller = false;
    while (plan_.steps > 1 && attempt([](TorturePlan& plan) { plan.steps /= 2; })) smaller = true;
    return smaller;
  }

  bool dropEffects() {
    bool smaller = false;
    const auto drop = [&](bool present, void (Effects::*clear)()) {
      if (present) smaller |= attempt([&](TorturePlan& plan) { (plan.scene.mutable_effects()->*clear)(); });
    };
    const auto effects = [&]() -> const Effects& { return plan_.scene.effects(); };
    drop(effects().has_adhesion(), &Effects::clear_adhesion);
    drop(effects().has_repulsion(), &Effects::clear_repulsion);
    drop(effects().has_core_radius(), &Effects::clear_core_radius);
    drop(effects().has_platelets(), &Effects::clear_platelets);
    drop(effects().has_surface_tension(), &Effects::clear_surface_tension);
    drop(effects().has_applied_force(), &Effects::clear_applied_force);
    drop(effects().has_viscosity(), &Effects::clear_viscosity);
    drop(effects().has_pressure(), &Effects::clear_pressure);
    drop(effects().has_gravity(), &Effects::clear_gravity);
    return smaller;
  }

  bool halveBlocks() {
    bool smaller = false;
    for (int k = 0; k < plan_.scene.fluid_blocks_size(); ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        while (attempt([&](TorturePlan& plan) { halve(plan, k, axis); })) smaller = true;
      }
    }
    return smaller;
  }

  static void halve(TorturePlan& plan, int block, int axis) {
    scene::FluidBlock& box = *plan.scene.mutable_fluid_blocks(block);
    const auto half = [](double lower, double upper) { return 0.5 * (lower + upper); };
    if (axis == 0) box.mutable_upper_m()->set_x(half(box.lower_m().x(), box.upper_m().x()));
    if (axis == 1) box.mutable_upper_m()->set_y(half(box.lower_m().y(), box.upper_m().y()));
    if (axis == 2) box.mutable_upper_m()->set_z(half(box.lower_m().z(), box.upper_m().z()));
  }

  bool dropDetails() {
    bool smaller = false;
    const auto simplify = [&](bool given, const auto& change) {
      if (given) smaller |= attempt(change);
    };
    simplify(plan_.threads > 1, [](TorturePlan& plan) { plan.threads = 1; });
    simplify(plan_.scene.has_max_dt_s(), [](TorturePlan& plan) { plan.scene.clear_max_dt_s(); });
    simplify(plan_.scene.resolution().has_support_ratio(),
             [](TorturePlan& plan) { plan.scene.mutable_resolution()->clear_support_ratio(); });
    for (std::size_t k = 0; k < plan_.changes.size(); ++k) {
      simplify(!plan_.changes[k].change.settings.empty(), [k](TorturePlan& plan) { plan.changes[k].change.settings.clear(); });
    }
    for (int k = 0; k < plan_.scene.fluid_blocks_size(); ++k) {
      const scene::FluidBlock& block = plan_.scene.fluid_blocks(k);
      simplify(block.jitter() != 0.0, [k](TorturePlan& plan) { plan.scene.mutable_fluid_blocks(k)->clear_jitter(); });
      simplify(block.has_viscosity_pa_s(),
               [k](TorturePlan& plan) { plan.scene.mutable_fluid_blocks(k)->clear_viscosity_pa_s(); });
      simplify(block.has_platelet(), [k](TorturePlan& plan) { plan.scene.mutable_fluid_blocks(k)->clear_platelet(); });
      simplify(block.has_velocity_m_per_s(),
               [k](TorturePlan& plan) { plan.scene.mutable_fluid_blocks(k)->clear_velocity_m_per_s(); });
    }
    return smaller;
  }

  TorturePlan plan_;
  const std::function<bool(const TorturePlan&)>& fails_;
  int tries_;
};

}  // namespace

TorturePlan shrink(TorturePlan plan, const std::function<bool(const TorturePlan&)>& fails, int tries) {
  return Shrinker{std::move(plan), fails, tries}.shrink();
}

}  // namespace bleedsim::lab
