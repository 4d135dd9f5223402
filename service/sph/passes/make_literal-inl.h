// Fills a LiteralTable.
#if defined(BLEEDSIM_SPH_PASSES_MAKE_LITERAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_MAKE_LITERAL_INL_H_
#undef BLEEDSIM_SPH_PASSES_MAKE_LITERAL_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_MAKE_LITERAL_INL_H_
#endif

#include <utility>

#include "service/sph/passes/density_pass-inl.h"
#include "service/sph/passes/literal_pass-inl.h"
#include "service/sph/passes/literal_table.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// One force pass serves both kinds of boundary, for half the code. Where no side is periodic, three tests of each vector find
/// that out: the whole step takes 2 % longer, as much as its times scatter.
template <class L, std::size_t kIndex>
constexpr LiteralFunction<typename L::Scalar> literalPassAt() {
  constexpr LiteralSet kSet = LiteralSet::at(kIndex);
  if constexpr (kSet.empty())
    return nullptr;
  else
    return &ListSweep<L, Spiky, true, false, LiteralBody<L, kSet>>::run;
}

template <class L, bool kPeriodic>
constexpr LiteralTable<typename L::Scalar> makeLiteralTable() {
  using Real = typename L::Scalar;
  LiteralTable<Real> table;
  table.passes.lanes = L::kWidth;
  table.passes.density = {{{&DensityPass<L, Poly6, kPeriodic, false, SupportRadius::common>::run,
                            &DensityPass<L, Poly6, kPeriodic, false, SupportRadius::own>::run},
                           {&DensityPass<L, Poly6, kPeriodic, true, SupportRadius::common>::run,
                            &DensityPass<L, Poly6, kPeriodic, true, SupportRadius::own>::run}}};
  table.force = []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array<LiteralFunction<Real>, LiteralSet::kCount>{literalPassAt<L, kIndex>()...};
  }
  (std::make_index_sequence<LiteralSet::kCount>{});
  return table;
}

template <class L>
const LiteralTable<typename L::Scalar>* literalTableOf(bool periodic) {
  static constexpr LiteralTable<typename L::Scalar> kBounded = makeLiteralTable<L, false>();
  static constexpr LiteralTable<typename L::Scalar> kPeriodic = makeLiteralTable<L, true>();
  return periodic ? &kPeriodic : &kBounded;
}

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
