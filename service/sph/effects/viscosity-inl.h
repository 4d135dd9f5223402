// Viscosity in the Brookshaw/Morris form.
//
// Equation (25) of the paper; Brookshaw 1985, Morris 1997; harmonic mean after Cleary & Monaghan 1999.
//   a_i = sum_j m 2 mubar/(rho_i rho_j) (r_ij . grad_i W)/(r^2 + 0.01 h^2) (v_i - v_j)        mubar = 2 mu_i mu_j/(mu_i + mu_j)
// terms: mu Pa s; v m/s. (r . grad W)/(r^2 + 0.01 h^2) = -norm/h^5 q^2 gradient(q)/(q^2 + 0.01) (kernels-inl.h); the prefactor
// K = 2 m norm/h^5 takes the rest-lattice factor on mu (rest_lattice.h).
// Deviation from the paper: its lap W of (33) with a mean of mu_i alone breaks Newton's third law; the Laplacian of Wendland C2
// is negative near the middle. 1/mu is stored, so a pair costs one division.
#if defined(BLEEDSIM_SPH_EFFECTS_VISCOSITY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_VISCOSITY_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_VISCOSITY_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_VISCOSITY_INL_H_
#endif

#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// kHarmonic: viscosity differs between particles; otherwise one value stands in the job's scale.
template <class L, bool kHarmonic>
class Viscosity {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr int kGroups = kHarmonic ? 3 : 2;

  Viscosity(const ForceJob<Real>& job, const Real* record)
      : vx_{L::set(record[kRecordVx])},
        vy_{L::set(record[kRecordVy])},
        vz_{L::set(record[kRecordVz])},
        scale_{L::set(job.viscosity_scale * record[kRecordInverseDensity])} {
    if constexpr (kHarmonic) own_inverse_ = L::set(record[kRecordInverseViscosity]);
  }

  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const {
    V divisor = p.q2 + L::set(Real(0.01));
    if constexpr (kHarmonic) divisor = divisor * (own_inverse_ + p.field[kRecordInverseViscosity]);
    const V drag = scale_ * (p.q2 * p.gradient * p.field[kRecordInverseDensity] / divisor);
    sums.ax = L::mulAdd(drag, p.field[kRecordVx] - vx_, sums.ax);
    sums.ay = L::mulAdd(drag, p.field[kRecordVy] - vy_, sums.ay);
    sums.az = L::mulAdd(drag, p.field[kRecordVz] - vz_, sums.az);
  }

 private:
  V vx_, vy_, vz_;
  V scale_;
  V own_inverse_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
