// The paper's kernels in the pair loop, with one support radius for all particles or, with (34), the particle's own.
//
// Equation (34) of the paper; literal_core_radius.h moves the radii.
//   density      norm/h_i^d weight(q h/h_i)      (density_pass-inl.h, SupportRadius::own)
//   grad, lap    norm/h_i^(d+2) of the same
// terms: h_i m; d dimension. Only the own radius: what i feels of j is not what j feels of i where their radii differ.
// Deviation from the paper: contacts (35) are seen out to h where h_i is smaller.
#if defined(BLEEDSIM_SPH_EFFECTS_LITERAL_CORE_RADIUS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_EFFECTS_LITERAL_CORE_RADIUS_INL_H_
#undef BLEEDSIM_SPH_EFFECTS_LITERAL_CORE_RADIUS_INL_H_
#else
#define BLEEDSIM_SPH_EFFECTS_LITERAL_CORE_RADIUS_INL_H_
#endif

#include "service/sph/passes/direct_search-inl.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/paper_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L, bool kOwn>
class CoreRadiusOf;

template <class L>
class CoreRadiusOf<L, false> {
 public:
  using Real = typename L::Scalar;
  explicit CoreRadiusOf(const Real*) {}
  HWY_INLINE PaperWeights<L> weights(const Pair<L>& p) const { return {p.gradient, complementOf<L>(p.q)}; }
  Real inverse2() const { return Real(1); }
  Real reach2() const { return Real(1); }
};

template <class L>
class CoreRadiusOf<L, true> {
 public:
  using V = typename L::V;
  using Real = typename L::Scalar;
  explicit CoreRadiusOf(const Real* record)
      : inverse_{L::set(record[kRecordInverseRadius])},
        factor_{L::set(record[kRecordRadiusFactor] * record[kRecordInverseRadius] * record[kRecordInverseRadius])},
        record_{record} {}
  HWY_INLINE PaperWeights<L> weights(const Pair<L>& p) const {
    const V q = p.q * inverse_;
    return {factor_ * Spiky<L>::gradient(q), factor_ * complementOf<L>(q)};
  }
  Real inverse2() const { return record_[kRecordInverseRadius] * record_[kRecordInverseRadius]; }
  Real reach2() const { return ownReach2(record_); }

 private:
  V inverse_;
  V factor_;
  const Real* record_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
