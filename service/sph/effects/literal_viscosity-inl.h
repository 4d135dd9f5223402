// Viscosity as printed.
//
// Equations (25), (33) of the paper:   a_i = mu_i m sum_j (v_j - v_i)/(rho_i rho_j) lap W,   mu_i by (26) or the scene's
// terms: mu Pa s; v m/s; a m/s^2; K = m x norm of (33)/h^5.
// Deviation from the paper: none. mu_i of the particle itself breaks Newton's third law where viscosity differs.
#if defined(BLEEDSIM_SPH_EFFECTS_LITERAL_VISCOSITY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_LITERAL_VISCOSITY_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_LITERAL_VISCOSITY_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_LITERAL_VISCOSITY_INL_H_
#endif

#include "service/sph/passes/literal_job.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/paper_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class LiteralViscosity {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr int kGroups = 2;  // of neighbours; of its own it reads the third

  LiteralViscosity(const LiteralJob<Real>& job, const Real* record)
      : vx_{L::set(record[kRecordVx])},
        vy_{L::set(record[kRecordVy])},
        vz_{L::set(record[kRecordVz])},
        scale_{L::set(job.viscosity_scale * record[kRecordInverseDensity] / record[kRecordInverseViscosity])} {}

  HWY_INLINE void pair(const Pair<L>& p, const PaperWeights<L>& w, PairSums<L>& sums) const {
    const V drag = scale_ * (w.complement * p.field[kRecordInverseDensity]);
    sums.ax = L::mulAdd(drag, p.field[kRecordVx] - vx_, sums.ax);
    sums.ay = L::mulAdd(drag, p.field[kRecordVy] - vy_, sums.ay);
    sums.az = L::mulAdd(drag, p.field[kRecordVz] - vz_, sums.az);
  }

 private:
  V vx_, vy_, vz_;
  V scale_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
