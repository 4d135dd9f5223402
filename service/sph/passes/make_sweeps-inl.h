// Fills a SweepTable.
#if defined(BLEEDSIM_SPH_PASSES_MAKE_SWEEPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_MAKE_SWEEPS_INL_H_
#undef BLEEDSIM_SPH_PASSES_MAKE_SWEEPS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_MAKE_SWEEPS_INL_H_
#endif

#include "service/sph/effects/curvature-inl.h"
#include "service/sph/effects/platelets-inl.h"
#include "service/sph/effects/shear_rate-inl.h"
#include "service/sph/effects/viscous_product-inl.h"
#include "service/sph/passes/list_sweep-inl.h"
#include "service/sph/passes/sweep_table.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L, bool kPeriodic, bool kRadius>
constexpr SweepTable<typename L::Scalar> makeSweeps() {
  SweepTable<typename L::Scalar> table;
  table.shear_rate = &ListSweep<L, WendlandC2, kPeriodic, kRadius, ShearMoments<L>>::run;
  table.platelets = &ListSweep<L, WendlandC2, kPeriodic, kRadius, PlateletDiffusion<L>>::run;
  table.viscous_product = &ListSweep<L, WendlandC2, kPeriodic, kRadius, ViscousProduct<L, true>>::run;
  if constexpr (!kRadius)
    table.uniform_viscous_product = &ListSweep<L, WendlandC2, kPeriodic, false, ViscousProduct<L, false>>::run;
  table.curvature = &ListSweep<L, WendlandC2, kPeriodic, kRadius, CurvatureBody<L, kRadius>>::run;
  return table;
}

template <class L>
const SweepTable<typename L::Scalar>* sweepsOf(const SweepChoice& choice) {
  using Table = SweepTable<typename L::Scalar>;
  static constexpr Table kTables[2][2] = {{makeSweeps<L, false, false>(), makeSweeps<L, false, true>()},
                                          {makeSweeps<L, true, false>(), makeSweeps<L, true, true>()}};
  return &kTables[choice.periodic ? 1 : 0][choice.core_radius ? 1 : 0];
}

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
