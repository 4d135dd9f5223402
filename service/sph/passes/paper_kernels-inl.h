// The paper's kernels in units of the support radius, without their norms, as functions of q = r/h, t = 1 - q:
//   poly6 (29)       W      = norm/h^3 weight(q)                 (1-q^2)^3
//   spiky (31)       grad_i W = norm/h^5 gradient(q) (x_j - x_i)  t^2/q, the sign mended
//   viscosity (33)   lap W  = norm/h^5 t
// All are 0 at and beyond the support's edge. lap of spiky = norm/h^5 (2 t - (d-1) t^2/q) with the gradient's norm; d is the
// dimension. smoothing_kernel.h has the closed forms and the norms.
#if defined(BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_
#undef BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_
#endif

#include "service/sph/passes/pair_geometry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// t = 1 - q, 0 beyond the support.
template <class L>
HWY_INLINE typename L::V complementOf(typename L::V q) {
  using Real = typename L::Scalar;
  return L::max(L::set(Real(1)) - q, L::set(Real(0)));
}

template <class L>
struct Poly6 {
  using V = typename L::V;
  using Real = typename L::Scalar;
  HWY_INLINE static V weight(V q) {
    const V u = L::max(L::subMul(L::set(Real(1)), q, q), L::set(Real(0)));
    return u * u * u;
  }
};

/// Its gradient has no limit at r = 0: see inverseDistance().
template <class L>
struct Spiky {
  using V = typename L::V;
  using Real = typename L::Scalar;
  HWY_INLINE static V gradient(V q) {
    const V t = complementOf<L>(q);
    return t * t * inverseDistance<L>(q);
  }
};

/// What the literal effects see of the kernels for a vector of neighbours.
template <class L>
struct PaperWeights {
  typename L::V gradient;    ///< of spiky
  typename L::V complement;  ///< t of (33)
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
