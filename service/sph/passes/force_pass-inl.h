// The one fused pair loop: every enabled pair effect adds to particle i's acceleration. Particle i gathers; nobody scatters.
#if defined(BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_
#undef BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_FORCE_PASS_INL_H_
#endif

#include <algorithm>

#include "service/sph/passes/direct_search-inl.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/pass_jobs.h"
#include "service/sph/passes/wendland_c2-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// The enabled effects for one particle. Plain inheritance: standard library helpers are compiled for the baseline and would not
/// be inlined here.
template <class L, PairEffect<L>... Effects>
class EffectPack : private Effects... {
 public:
  using Real = typename L::Scalar;
  EffectPack(const ForceJob<Real>& job, const Real* record) : Effects{job, record}... {}
  HWY_INLINE void pair(const Pair<L>& p, PairSums<L>& sums) const { (Effects::pair(p, sums), ...); }
};

template <class L, bool kPeriodic, PairEffect<L>... Effects>
class ForcePass {
 public:
  using Real = typename L::Scalar;
  using V = typename L::V;

  static void run(const ForceJob<Real>& job) {
    for (int row = job.row_begin; row < job.row_end; ++row) {
      const std::uint32_t end = job.grid.rowEnd(row);
      for (std::uint32_t i = job.grid.rowBegin(row); i < end; ++i) {
        if (job.blocks[i] != kOverflowList) {
          particle(job, i, job.entries + static_cast<std::size_t>(job.list_at[i]) * L::kWidth, job.blocks[i]);
        } else {
          particleWithoutList(job, i, row);
        }
      }
    }
  }

 private:
  static constexpr int kGroups = std::max({Effects::kGroups...});
  static constexpr std::uint32_t kStride = 4 * kGroups;

  static void particle(const ForceJob<Real>& job, std::uint32_t i, const std::uint32_t* list, int blocks) {
    const Real* own = job.record + static_cast<std::size_t>(i) * kStride;
    const EffectPack<L, Effects...> effects{job, own};
    PairSums<L> sums{L::set(Real(0)), L::set(Real(0)), L::set(Real(0))};
    addBlocks(job, own, list, blocks, effects, sums);
    L::storeSums(sums.ax, sums.ay, sums.az, job.acceleration + static_cast<std::size_t>(i) * 4);
  }

  HWY_INLINE static void addBlocks(const ForceJob<Real>& job, const Real* own, const std::uint32_t* list, int blocks,
                                   const EffectPack<L, Effects...>& effects, PairSums<L>& sums) {
    const V x = L::set(own[kRecordX]);
    const V y = L::set(own[kRecordY]);
    const V z = L::set(own[kRecordZ]);
    const V one = L::set(Real(1));
    const V zero = L::set(Real(0));
    for (; blocks > 0; --blocks, list += L::kWidth) {
      Pair<L> p;
      for (int g = 0; g < kGroups; ++g) L::gatherGroup(job.record + 4 * g, list, p.field + 4 * g);
      p.dx = p.field[kRecordX] - x;
      p.dy = p.field[kRecordY] - y;
      p.dz = p.field[kRecordZ] - z;
      if constexpr (kPeriodic) {
        p.dx = nearest(p.dx, job.grid.periodic[0], job.grid.period[0]);
        p.dy = nearest(p.dy, job.grid.periodic[1], job.grid.period[1]);
        p.dz = nearest(p.dz, job.grid.periodic[2], job.grid.period[2]);
      }
      p.q2 = L::mulAdd(p.dz, p.dz, L::mulAdd(p.dy, p.dy, p.dx * p.dx));
      p.gradient = WendlandC2<L>::gradient(L::max(one - L::sqrt(p.q2), zero));
      effects.pair(p, sums);
    }
  }

  /// The minimum image; at most one period is taken off, so that the far dummy stays far.
  static V nearest(V d, bool periodic, Real period) {
    if (!periodic) return d;
    const V image = L::max(L::min(L::round(d * L::set(Real(1) / period)), L::set(Real(1))), L::set(Real(-1)));
    return L::subMul(d, image, L::set(period));
  }

  /// A particle without a list: its neighbours come straight from the cells.
  static void particleWithoutList(const ForceJob<Real>& job, std::uint32_t i, int row) {
    const Real* own = job.record + static_cast<std::size_t>(i) * kStride;
    const EffectPack<L, Effects...> effects{job, own};
    PairSums<L> sums{L::set(Real(0)), L::set(Real(0)), L::set(Real(0))};

    int cx = 1;
    while (job.grid.start[job.grid.cell(row, cx) + 1] <= i) ++cx;
    NeighborRun<Real> runs[GridView<Real>::kMaxRuns];
    const int run_count = job.grid.template neighborRuns<kPeriodic>(row, cx, runs);

    DirectSearch<L, kPeriodic>::run(job, runs, run_count, i, kStride, [&](const Real*, const std::uint32_t* list, int blocks) {
      addBlocks(job, own, list, blocks, effects, sums);
    });
    L::storeSums(sums.ax, sums.ay, sums.az, job.acceleration + static_cast<std::size_t>(i) * 4);
  }
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
