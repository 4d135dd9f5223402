// pe^n1 - pe^n2 of (36), n1 > n2 >= 1, as pe^n2 (pe^(n1-n2) - 1): never negative for pe >= 1, and for even powers, the usual
// ones, from pe^2 alone.
#if defined(BLEEDSIM_SPH_EFFECTS_POWER_GAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_POWER_GAP_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_POWER_GAP_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_POWER_GAP_INL_H_
#endif

#include "service/sph/passes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
class PowerGap {
 public:
  using V = typename L::V;

  explicit PowerGap(const int (&powers)[2]) : even_{(powers[0] | powers[1]) % 2 == 0} {
    const int halvings = even_ ? 1 : 0;
    lower_ = powers[1] >> halvings;
    difference_ = (powers[0] - powers[1]) >> halvings;
  }

  /// pe >= 1.
  HWY_INLINE V operator()(V pe) const {
    const V base = even_ ? pe * pe : pe;
    return power(base, lower_) * (power(base, difference_) - L::set(typename L::Scalar(1)));
  }

 private:
  HWY_INLINE static V power(V base, int exponent) {
    V result = base;
    for (int k = 1; k < exponent; ++k) result = result * base;
    return result;
  }

  bool even_;
  int lower_, difference_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
