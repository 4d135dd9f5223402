// Pressure of weakly compressible blood.
//
// Equations (16), (17), (19), (20) of the paper; Monaghan 1992.
//   variational (16)   a_i = -m sum_j (p_i/rho_i^2 + p_j/rho_j^2) grad_i W       p = max(0, p0 + c0^2 (rho - rho0))
//   symmetric   (17)   a_i = -m sum_j (p_i + p_j)/(2 rho_i rho_j) grad_i W
// terms: p Pa; rho kg/m^3; m kg; a m/s^2. The record carries K p/rho^2, or K p/2 for (17), with K = m x gradient norm/h^4, so a
// pair is one product.
// Deviation from the paper: (16) by default instead of (17), which loses energy; one kernel for both density and gradient;
// p >= 0, because a free surface would tear under negative pressure. Walls: tissue/ adds the wall's share.
#if defined(BLEEDSIM_SPH_EFFECTS_PRESSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_PRESSURE_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_PRESSURE_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_PRESSURE_INL_H_
#endif

#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class VariationalPressure {
 public:
  using Real = typename L::Scalar;
  static constexpr int kGroups = 1;

  VariationalPressure(const ForceJob<Real>&, const Real* record) : own_{L::set(record[kRecordPressure])} {}

  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const {
    const auto push = p.gradient * (p.field[kRecordPressure] + own_);
    sums.ax = L::subMul(sums.ax, push, p.dx);
    sums.ay = L::subMul(sums.ay, push, p.dy);
    sums.az = L::subMul(sums.az, push, p.dz);
  }

 private:
  typename L::V own_;
};

template <class L>
class SymmetricPressure {
 public:
  using Real = typename L::Scalar;
  static constexpr int kGroups = 2;

  SymmetricPressure(const ForceJob<Real>&, const Real* record)
      : own_{L::set(record[kRecordPressure])}, own_inverse_{L::set(record[kRecordInverseDensity])} {}

  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const {
    const auto push = p.gradient * (p.field[kRecordPressure] + own_) * (own_inverse_ * p.field[kRecordInverseDensity]);
    sums.ax = L::subMul(sums.ax, push, p.dx);
    sums.ay = L::subMul(sums.ay, push, p.dy);
    sums.az = L::subMul(sums.az, push, p.dz);
  }

 private:
  typename L::V own_;
  typename L::V own_inverse_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
