// One particle against a vector of neighbours, as every pair effect sees it.
#if defined(BLEEDSIM_SPH_PASSES_PAIR_GEOMETRY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_PAIR_GEOMETRY_INL_H_
#undef BLEEDSIM_SPH_PASSES_PAIR_GEOMETRY_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_PAIR_GEOMETRY_INL_H_
#endif

#include <concepts>

#include "service/sph/effects/pair_set.h"
#include "service/sph/passes/lanes-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

template <class L>
struct Pair {
  typename L::V dx, dy, dz;                   ///< (x_j - x_i) / h
  typename L::V q;                            ///< r/h
  typename L::V q2;                           ///< its square
  typename L::V gradient;                     ///< of the kernel (kernels-inl.h); 0 beyond the support
  typename L::V field[4 * kMaxRecordGroups];  ///< the neighbours' record fields
  const std::uint32_t* list;                  ///< their record offsets
};

/// 1/q, and nothing in the same place: below h/1e6 it falls to 0, for a particle on another's spot (or the particle itself) gives
/// no direction.
template <class L>
HWY_INLINE typename L::V inverseDistance(typename L::V q) {
  using Real = typename L::Scalar;
  return q / L::max(q * q, L::set(Real(1e-12)));
}

/// What the effects add to: the acceleration of particle i, m/s^2, and the rate of its platelets, 1/s.
template <class L>
struct PairSums {
  typename L::V ax, ay, az;
  typename L::V rate;

  static PairSums zero() { return {L::set(0), L::set(0), L::set(0), L::set(0)}; }
  void store(typename L::Scalar* p) const { L::storeSums(ax, ay, az, rate, p); }
};

/// An effect that acts inside the fused pair loop: built once for each particle from its record, then asked for each vector of
/// neighbours. kGroups is how many groups of record fields it reads (pair_set.h).
template <class E, class L>
concept PairEffect = std::constructible_from < E,
        const ForceJob<typename L::Scalar>
&, const typename L::Scalar* > &&requires(const E& effect, const Pair<L>& pair, PairSums<L>& sums) {
  { E::kGroups } -> std::convertible_to<int>;
  { effect.pair(pair, sums) } -> std::same_as<void>;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
