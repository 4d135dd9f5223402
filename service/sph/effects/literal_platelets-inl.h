// Diffusion of platelets as printed.
//
// Equations (27), (33) of the paper:   dP_i/dt = k lap P,   lap P_i = sum_j m (P_j - P_i)/rho_j lap W
// terms: P 0 to 1; k m^2/s. literal_forces.h turns P into viscosity (26) and moves it on in time.
// Deviation from the paper: none. Diffusion alone keeps a uniform P and so never clots.
#if defined(BLEEDSIM_SPH_EFFECTS_LITERAL_PLATELETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_LITERAL_PLATELETS_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_LITERAL_PLATELETS_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_LITERAL_PLATELETS_INL_H_
#endif

#include "service/sph/passes/literal_job.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/paper_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class LiteralPlatelets {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr int kGroups = 2;

  LiteralPlatelets(const LiteralJob<Real>& job, const Real* record)
      : scale_{L::set(job.platelet_scale)}, own_{L::set(record[kRecordLiteralPlatelet])} {}

  HWY_INLINE void pair(const Pair<L>& p, const PaperWeights<L>& w, PairSums<L>& sums) const {
    sums.rate =
        L::mulAdd(scale_ * (w.complement * p.field[kRecordInverseDensity]), p.field[kRecordLiteralPlatelet] - own_, sums.rate);
  }

 private:
  V scale_;
  V own_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
