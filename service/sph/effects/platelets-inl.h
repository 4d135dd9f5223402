// Diffusion of platelets.
//
// Equation (27) of the paper: dP/dt = k lap P. Brookshaw form, as for viscosity:
//   dP_i/dt = sum_j 2 k Vbar (r_ij . grad_i W)/(r^2 + 0.01 h^2) (P_i - P_j)        Vbar = (m/rho_i + m/rho_j)/2
// terms: P 0 to 1; k m^2/s. The prefactor K = 2 m norm/h^5 is the one of viscosity-inl.h, its rest-lattice factor included.
// Deviation from the paper: the mean of both volumes makes the exchange reciprocal, so that sum P is constant to rounding; the
// Laplacian of (33) with m_j/rho_j alone is not. platelets.h adds what makes blood clot.
#if defined(BLEEDSIM_SPH_EFFECTS_PLATELETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_PLATELETS_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_PLATELETS_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_PLATELETS_INL_H_
#endif

#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/platelet_job.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// A walk of its own: it is due in one of several steps (platelets.h).
template <class L>
class PlateletDiffusion {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  using Job = PlateletJob<Real>;
  static constexpr int kGroups = kPlateletGroups;

  PlateletDiffusion(const Job& job, std::uint32_t, const Real* record)
      : scale_{L::set(job.scale)}, own_inverse_{L::set(record[kRecordInverseDensity])}, own_{L::set(record[kRecordPlatelet])} {}

  HWY_INLINE void pair(const Pair<L>& p) {
    const V exchange =
        scale_ * (own_inverse_ + p.field[kRecordInverseDensity]) * (p.q2 * p.gradient / (p.q2 + L::set(Real(0.01))));
    rate_ = L::mulAdd(exchange, p.field[kRecordPlatelet] - own_, rate_);
  }

  void finish(const Job& job, std::uint32_t i) const {
    alignas(64) Real sums[4];
    L::storeSums(rate_, L::set(Real(0)), L::set(Real(0)), L::set(Real(0)), sums);
    job.acceleration[std::size_t{i} * 4 + 3] = sums[0];
  }

 private:
  V scale_;
  V own_inverse_;
  V own_;
  V rate_ = L::set(Real(0));
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
