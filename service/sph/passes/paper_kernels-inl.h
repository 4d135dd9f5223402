// The paper's kernels in units of the support radius, without their norms, as functions of q2 = (r/h)^2, t = 1 - q:
//   poly6 (29)       W      = norm/h^3 weight(q2)                 (1-q^2)^3
//   spiky (31)       grad_i W = norm/h^5 gradient(q2) (x_j - x_i)  t^2/q, the sign mended
//   viscosity (33)   lap W  = norm/h^5 t
// All are 0 at and beyond the support's edge. lap of spiky = norm/h^5 (2 t - (d-1) t^2/q) with the gradient's norm; d is the
// dimension. smoothing_kernel.h has the closed forms and the norms.
#if defined(BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_
#undef BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_PAPER_KERNELS_INL_H_
#endif

#include "service/sph/passes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// t = 1 - q, 0 beyond the support.
template <class L>
HWY_INLINE typename L::V complementOf(typename L::V q2) {
  using Real = typename L::Scalar;
  return L::max(L::set(Real(1)) - L::sqrt(q2), L::set(Real(0)));
}

/// 1/q2, no more than 1e12: what divides by a distance takes its root times this, so that root and division run side by side.
template <class L>
HWY_INLINE typename L::V inverseSquare(typename L::V q2) {
  using Real = typename L::Scalar;
  return L::set(Real(1)) / L::max(q2, L::set(Real(1e-12)));
}

template <class L>
struct Poly6 {
  using V = typename L::V;
  using Real = typename L::Scalar;
  HWY_INLINE static V weight(V q2) {
    const V u = L::max(L::set(Real(1)) - q2, L::set(Real(0)));
    return u * u * u;
  }
};

/// Its gradient has no limit at r = 0: from h/1e6 down it falls to nothing, so that a particle on another's spot (or the particle
/// itself) adds nothing.
template <class L>
struct Spiky {
  using V = typename L::V;
  using Real = typename L::Scalar;
  HWY_INLINE static V gradient(V q2) {
    const V t = complementOf<L>(q2);
    return t * t * (L::sqrt(q2) * inverseSquare<L>(q2));
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
