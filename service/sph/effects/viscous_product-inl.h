// Viscous acceleration in the central form, as the matrix of the implicit solve.
//
// Monaghan 2005; physics.md section 2:
//   a_i = sum_j m 10 mubar/(rho_i rho_j) (v_ij . r_ij)/(r^2 + 0.01 h^2) grad_i W        mubar = 2 mu_i mu_j/(mu_i + mu_j)
// 10 = 2 (d + 2) in three dimensions. Forces act along the pair, so angular momentum stays; the Brookshaw form of the explicit
// pass slows a rigid rotation at a free surface, which a large viscosity would turn into a brake.
// Where particles stand in a lattice it depends on direction: an axis-aligned shear feels 0.6 / 0.8 / 0.9 of the viscosity at
// h = 2 / 2.5 / 3 dx.
// The prefactor is five times the one of viscosity-inl.h, with its rest-lattice factor.
#if defined(BLEEDSIM_SPH_EFFECTS_VISCOUS_PRODUCT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_VISCOUS_PRODUCT_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_VISCOUS_PRODUCT_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_VISCOUS_PRODUCT_INL_H_
#endif

#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/viscous_product_job.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// kHarmonic as in Viscosity.
template <class L, bool kHarmonic>
class ViscousProduct {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  using Job = ViscousProductJob<Real>;
  static constexpr int kGroups = kHarmonic ? 3 : 2;

  ViscousProduct(const Job& job, std::uint32_t, const Real* record)
      : vx_{L::set(record[kRecordVx])},
        vy_{L::set(record[kRecordVy])},
        vz_{L::set(record[kRecordVz])},
        scale_{L::set(job.scale * record[kRecordInverseDensity])} {
    if constexpr (kHarmonic) own_inverse_ = L::set(record[kRecordInverseViscosity]);
  }

  HWY_INLINE void pair(const Pair<L>& p) {
    V divisor = p.q2 + L::set(Real(0.01));
    if constexpr (kHarmonic) divisor = divisor * (own_inverse_ + p.field[kRecordInverseViscosity]);
    const V weight = scale_ * (p.gradient * p.field[kRecordInverseDensity] / divisor);
    const V along =
        L::mulAdd(p.field[kRecordVz] - vz_, p.dz, L::mulAdd(p.field[kRecordVy] - vy_, p.dy, (p.field[kRecordVx] - vx_) * p.dx));
    const V pull = weight * along;
    sums_.ax = L::mulAdd(pull, p.dx, sums_.ax);
    sums_.ay = L::mulAdd(pull, p.dy, sums_.ay);
    sums_.az = L::mulAdd(pull, p.dz, sums_.az);
    sums_.rate = L::subMul(sums_.rate, weight * p.q2, L::set(Real(1) / Real(3)));
  }

  void finish(const Job& job, std::uint32_t i) const { sums_.store(job.product + static_cast<std::size_t>(i) * 4); }

 private:
  V vx_, vy_, vz_;
  V scale_;
  V own_inverse_;
  PairSums<L> sums_ = PairSums<L>::zero();
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
