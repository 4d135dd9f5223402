// Repulsion as printed.
//
// Equations (35), (36) and Table I of the paper:
//   pe = (r_i + r_j)/d > 1:  a_i = D/m (pe^n1 - pe^n2)/d^2 along x_i - x_j, and nothing else acts between the two; else 0
// terms: r contact radius m; d distance m; D N m^2. The paper prints D = 1e5 without a unit.
// Deviation from the paper: none above d = h/1000; below it d stays there, and one pair gives at most 1e15 m/s^2, so that numbers
// stay finite. Two particles on one spot have no direction and so no force.
#if defined(BLEEDSIM_SPH_EFFECTS_LITERAL_REPULSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_LITERAL_REPULSION_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_LITERAL_REPULSION_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_LITERAL_REPULSION_INL_H_
#endif

#include "service/sph/effects/power_gap-inl.h"
#include "service/sph/passes/literal_job.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/paper_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class LiteralRepulsion {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr int kGroups = 1;

  LiteralRepulsion(const LiteralJob<Real>& job, const Real*) : job_{&job}, gap_{job.repulsion_powers} {}

  /// Table I's else: 0 between particles in contact, `value` between others.
  HWY_INLINE V apart(const Pair<L>& p, V value) const { return L::ifBelow(p.q, L::set(job_->contact), L::set(Real(0)), value); }

  HWY_INLINE void pair(const Pair<L>& p, const PaperWeights<L>&, PairSums<L>& sums) const {
    const V contact = L::set(job_->contact);
    const V one = L::set(Real(1));
    const V inverse_distance = inverseDistance<L>(p.q);
    const V capped = L::min(inverse_distance, L::set(Real(1e3)));
    const V push =
        L::min(L::set(job_->repulsion_scale) * gap_(L::max(contact * capped, one)) * (capped * capped), L::set(Real(1e15)));
    const V along = push * inverse_distance;
    sums.ax = L::subMul(sums.ax, along, p.dx);
    sums.ay = L::subMul(sums.ay, along, p.dy);
    sums.az = L::subMul(sums.az, along, p.dz);
  }

 private:
  const LiteralJob<Real>* job_;
  PowerGap<L> gap_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
