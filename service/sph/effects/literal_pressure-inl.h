// Pressure as printed.
//
// Equations (16), (17), (19), (20), (31) of the paper:
//   (16)  a_i = -m sum_j (p_i/rho_i^2 + p_j/rho_j^2) grad_i W
//   (17)  a_i = -m sum_j (p_i + p_j)/(2 rho_i rho_j) grad_i W                  the paper's choice
//   p = k (rho - rho0)   rho by poly6 (29), grad W by spiky (31)
// terms: p Pa, negative where rho < rho0; k m^2/s^2; rho kg/m^3; m kg; a m/s^2; K = m x gradient norm/h^4. No record carries p:
// K p/rho = K k + K (p_0 - k rho0)/rho, p_0 the background pressure.
// Deviation from the paper: the sign of (31), without which pressure attracts. m is calibrated (literal_model.h).
// Known of it: the sum of grad W vanishes in the bulk, so the own p_i adds nothing and (17) is half of -grad p/rho, (16) the
// whole: with (17) a column stands under twice the compression, and sound travels at sqrt(k/2).
#if defined(BLEEDSIM_SPH_EFFECTS_LITERAL_PRESSURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_LITERAL_PRESSURE_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_LITERAL_PRESSURE_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_LITERAL_PRESSURE_INL_H_
#endif

#include "service/sph/passes/literal_job.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/paper_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L, PressureTerm kTerm>
class LiteralPressure {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  static constexpr bool kSymmetric = kTerm == PressureTerm::symmetric;
  static constexpr int kGroups = 2;

  LiteralPressure(const LiteralJob<Real>& job, const Real* record)
      : constant_{L::set(job.pressure_constant)},
        slope_{L::set(job.pressure_slope)},
        inverse_{L::set(record[kRecordInverseDensity])},
        own_{kSymmetric ? overDensity(inverse_) : inverse_ * overDensity(inverse_)} {}

  HWY_INLINE void pair(const Pair<L>& p, const PaperWeights<L>& w, PairSums<L>& sums) const {
    const V inverse = p.field[kRecordInverseDensity];
    const V other = overDensity(inverse);
    const V both = kSymmetric ? L::mulAdd(other, inverse_, own_ * inverse) : L::mulAdd(other, inverse, own_);
    const V push = w.gradient * both;
    sums.ax = L::subMul(sums.ax, push, p.dx);
    sums.ay = L::subMul(sums.ay, push, p.dy);
    sums.az = L::subMul(sums.az, push, p.dz);
  }

 private:
  /// K p/rho by 1/rho.
  HWY_INLINE V overDensity(V inverse) const { return L::mulAdd(constant_, inverse, slope_); }

  V constant_;
  V slope_;
  V inverse_;
  V own_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
