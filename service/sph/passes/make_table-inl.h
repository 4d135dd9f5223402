// Fills a PassTable: the list of pair effects and of every set of them that is compiled.
#if defined(BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_
#undef BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_MAKE_TABLE_INL_H_
#endif

#include <type_traits>
#include <utility>

#include "service/sph/effects/pressure-inl.h"
#include "service/sph/effects/repulsion-inl.h"
#include "service/sph/effects/viscosity-inl.h"
#include "service/sph/passes/density_pass-inl.h"
#include "service/sph/passes/force_pass-inl.h"
#include "service/sph/passes/pass_table.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class... Effects>
struct EffectTypes {
  template <class... More>
  constexpr EffectTypes<Effects..., More...> operator+(EffectTypes<More...>) const {
    return {};
  }
};

template <bool kPresent, class... Effects>
constexpr auto effectsIf() {
  if constexpr (kPresent)
    return EffectTypes<Effects...>{};
  else
    return EffectTypes<>{};
}

/// The effects of a set, in the order in which they act.
template <class L, PairSet kSet>
constexpr auto effectsOf() {
  return effectsIf<kSet.pressure == PressureTerm::variational, VariationalPressure<L>>() +
         effectsIf<kSet.pressure == PressureTerm::symmetric, SymmetricPressure<L>>() +
         effectsIf<kSet.viscosity == ViscosityTerm::uniform, Viscosity<L, false>>() +
         effectsIf<kSet.viscosity == ViscosityTerm::harmonic, Viscosity<L, true>>() + effectsIf<kSet.repulsion, Repulsion<L>>();
}

template <class L, template <class> class Kernel, bool kPeriodic, PairSet kSet, class... Effects>
constexpr ForceFunction<typename L::Scalar> forcePass(EffectTypes<Effects...>) {
  using Normals = std::conditional_t<kSet.tension, NormalSums<L>, NoNormals<L>>;
  return &ListSweep<L, Kernel, kPeriodic, kSet.core_radius, ForceBody<L, Normals, Effects...>>::run;
}

/// Which sets a translation unit compiles: all of them, or pressure and viscosity alone.
enum class SetRange { all, plain };

template <class L, template <class> class Kernel, bool kPeriodic, SetRange kRange, std::size_t kIndex>
constexpr ForceFunction<typename L::Scalar> passAt() {
  constexpr PairSet kSet = PairSet::at(kIndex);
  constexpr bool kPlain = !kSet.tension && !kSet.repulsion && !kSet.core_radius;
  if constexpr (kSet.empty() || !kSet.legal() || (kRange == SetRange::plain && !kPlain))
    return nullptr;
  else
    return forcePass<L, Kernel, kPeriodic, kSet>(effectsOf<L, kSet>());
}

template <class L, template <class> class Kernel, bool kPeriodic, SetRange kRange>
constexpr std::array<ForceFunction<typename L::Scalar>, PairSet::kCount> forcePasses() {
  static_assert(PairSet::kCount <= 128, "an effect that needs more sets becomes a sweep of its own");
  return []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array<ForceFunction<typename L::Scalar>, PairSet::kCount>{passAt<L, Kernel, kPeriodic, kRange, kIndex>()...};
  }
  (std::make_index_sequence<PairSet::kCount>{});
}

template <class L, template <class> class Kernel, bool kPeriodic, bool kTissue, SetRange kRange>
constexpr std::array<DensityFunction<typename L::Scalar>, 2> densityPasses() {
  if constexpr (kRange == SetRange::plain)
    return {&DensityPass<L, Kernel, kPeriodic, kTissue, SupportRadius::common>::run, nullptr};
  else
    return {&DensityPass<L, Kernel, kPeriodic, kTissue, SupportRadius::common>::run,
            &DensityPass<L, Kernel, kPeriodic, kTissue, SupportRadius::mean>::run};
}

template <class L, template <class> class Kernel, bool kPeriodic, SetRange kRange>
constexpr PassTable<typename L::Scalar> makeTable() {
  PassTable<typename L::Scalar> table;
  table.lanes = L::kWidth;
  table.density = {densityPasses<L, Kernel, kPeriodic, false, kRange>(), densityPasses<L, Kernel, kPeriodic, true, kRange>()};
  table.force = forcePasses<L, Kernel, kPeriodic, kRange>();
  return table;
}

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
