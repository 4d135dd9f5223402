// Wendland C2 in units of the support radius, without its norm: weight(t) = t^4 (5 - 4t) and gradient(t) = t^3 with t = 1 - r/h.
// W = 21/(2 pi h^3) weight; grad_i W = 210/(pi h^5) gradient (x_j - x_i). Wendland 1995; smoothing_kernel.h has the closed forms.
#if defined(BLEEDSIM_SPH_PASSES_WENDLAND_C2_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_WENDLAND_C2_INL_H_
#undef BLEEDSIM_SPH_PASSES_WENDLAND_C2_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_WENDLAND_C2_INL_H_
#endif

#include "service/sph/passes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
struct WendlandC2 {
  using V = typename L::V;
  using Real = typename L::Scalar;
  static V weight(V t) {
    const V t2 = t * t;
    return t2 * t2 * L::subMul(L::set(Real(5)), L::set(Real(4)), t);
  }
  static V gradient(V t) { return t * t * t; }
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
