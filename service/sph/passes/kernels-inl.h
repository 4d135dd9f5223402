// The smoothing kernels of the sound model in units of the support radius, without their norms, as functions of q = r/h:
//   W = norm/h^3 weight(q);   grad_i W = gradient norm/h^5 gradient(q) (x_j - x_i)
// Both are 0 at and beyond the support's edge. smoothing_kernel.h has the closed forms and the norms (kernelNorms).
#if defined(BLEEDSIM_SPH_PASSES_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_KERNELS_INL_H_
#undef BLEEDSIM_SPH_PASSES_KERNELS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_KERNELS_INL_H_
#endif

#include "service/sph/passes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// Wendland C2 (Wendland 1995): weight t^4 (5 - 4t), gradient t^3, t = 1 - q.
template <class L>
struct WendlandC2 {
  using V = typename L::V;
  using Real = typename L::Scalar;
  HWY_INLINE static V weight(V q) {
    const V t = complement(q);
    const V t2 = t * t;
    return t2 * t2 * L::subMul(L::set(Real(5)), L::set(Real(4)), t);
  }
  HWY_INLINE static V gradient(V q) {
    const V t = complement(q);
    return t * t * t;
  }

 private:
  HWY_INLINE static V complement(V q) { return L::max(L::set(Real(1)) - q, L::set(Real(0))); }
};

/// Cubic spline (Monaghan 1992) as 2 (1-q)^3 - 8 max(0, 1/2 - q)^3, one form for both pieces. Its gradient goes as 1/q near the
/// support's edge only: for q < 1/2 the pieces cancel to 2 - 3q, so q is kept off zero without a branch.
template <class L>
struct CubicSpline {
  using V = typename L::V;
  using Real = typename L::Scalar;
  HWY_INLINE static V weight(V q) {
    const V outer = L::max(L::set(Real(1)) - q, L::set(Real(0)));
    const V inner = L::max(L::set(Real(0.5)) - q, L::set(Real(0)));
    return L::subMul(L::set(Real(2)) * outer * outer * outer, L::set(Real(8)) * inner, inner * inner);
  }
  /// dW/dr = -norm/h^4 (6 outer^2 - 24 inner^2); over q, with the norm 6 x 8 = 48: outer^2/q - 4 inner^2/q, in the middle 2 - 3q.
  HWY_INLINE static V gradient(V q) {
    const V outer = L::max(L::set(Real(1)) - q, L::set(Real(0)));
    const V middle = L::subMul(L::set(Real(2)), L::set(Real(3)), q);
    const V edge = outer * outer / L::max(q, L::set(Real(0.5)));
    return L::ifBelow(q, L::set(Real(0.5)), middle, edge);
  }
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
