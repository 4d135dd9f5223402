// The one fused pair loop: every enabled pair effect adds to particle i's acceleration. Particle i gathers; nobody scatters.
#if defined(BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_
#undef BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_
#endif

#include <algorithm>

#include "service/sph/effects/surface_normals-inl.h"
#include "service/sph/passes/list_sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// The enabled effects for one particle. Plain inheritance: standard library helpers are compiled for the baseline and would not
/// be inlined here.
template <class L, PairEffect<L>... Effects>
class EffectPack : private Effects... {
 public:
  using Real = typename L::Scalar;
  EffectPack(const ForceJob<Real>& job, [[maybe_unused]] const Real* record) : Effects{job, record}... {}
  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const { (Effects::pair(p, sums), ...); }
};

/// The loop as a body of the list sweep. Normals: NormalSums or NoNormals.
template <class L, class Normals, PairEffect<L>... Effects>
class ForceBody {
 public:
  using Real = typename L::Scalar;
  using Job = ForceJob<Real>;
  static constexpr int kGroups = std::max({1, Effects::kGroups...});

  ForceBody(const Job& job, std::uint32_t, const Real* record) : effects_{job, record} {}
  HWY_INLINE void pair(const Pair<L>& p) {
    effects_.pair(p, sums_);
    normals_.pair(p);
  }
  void finish(const Job& job, std::uint32_t i) const {
    sums_.store(job.acceleration + static_cast<std::size_t>(i) * 4);
    normals_.finish(job, i);
  }

 private:
  EffectPack<L, Effects...> effects_;
  PairSums<L> sums_ = PairSums<L>::zero();
  [[no_unique_address]] Normals normals_;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
