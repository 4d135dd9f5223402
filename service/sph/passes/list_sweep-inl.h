// The walk over the neighbour lists that every pair pass shares: for each particle of a share a body is made from its record, is
// given each vector of neighbours, and finishes. Particle i gathers; nobody scatters.
#if defined(BLEEDSIM_SPH_PASSES_LIST_SWEEP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_LIST_SWEEP_INL_H_
#undef BLEEDSIM_SPH_PASSES_LIST_SWEEP_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_LIST_SWEEP_INL_H_
#endif

#include "service/sph/passes/direct_search-inl.h"
#include "service/sph/passes/kernels-inl.h"
#include "service/sph/passes/pair_geometry-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// Body: Job (a SweepJob); kGroups, the record groups that it reads of each neighbour (from the first on; others by gatherGroup);
/// a constructor from (job, i, own record); pair(p); finish(job, i).
/// kRadius: the pair's gradient is that of (W(h_i) + W(h_j))/2, and kGroups covers the radius fields.
template <class L, template <class> class KernelOf, bool kPeriodic, bool kRadius, class Body>
class ListSweep {
 public:
  using Real = typename L::Scalar;
  using V = typename L::V;
  using Job = typename Body::Job;
  using Kernel = KernelOf<L>;

  static void run(const Job& job) {
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
  static constexpr int kGroups = kRadius && Body::kGroups < 3 ? 3 : Body::kGroups;

  static void particle(const Job& job, std::uint32_t i, const std::uint32_t* list, int blocks) {
    const Real* own = job.record + static_cast<std::size_t>(i) * static_cast<std::uint32_t>(4 * job.groups);
    Body body{job, i, own};
    addBlocks(job, own, list, blocks, body);
    body.finish(job, i);
  }

  HWY_INLINE static void addBlocks(const Job& job, const Real* own, const std::uint32_t* list, int blocks, Body& body) {
    const V x = L::set(own[kRecordX]);
    const V y = L::set(own[kRecordY]);
    const V z = L::set(own[kRecordZ]);
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
      p.list = list;
      if constexpr (kRadius) {
        const V mine = L::set(own[kRecordRadiusFactor]) * Kernel::gradient(p.q2 * L::set(own[kRecordInverseRadius2]));
        const V theirs = p.field[kRecordRadiusFactor] * Kernel::gradient(p.q2 * p.field[kRecordInverseRadius2]);
        p.gradient = L::set(Real(0.5)) * (mine + theirs);
      } else {
        p.gradient = Kernel::gradient(p.q2);
      }
      body.pair(p);
    }
  }

  /// The minimum image; at most one period is taken off, so that the far dummy stays far.
  static V nearest(V d, bool periodic, Real period) {
    if (!periodic) return d;
    const V image = L::max(L::min(L::round(d * L::set(Real(1) / period)), L::set(Real(1))), L::set(Real(-1)));
    return L::subMul(d, image, L::set(period));
  }

  /// A particle without a list: its neighbours come straight from the cells.
  static void particleWithoutList(const Job& job, std::uint32_t i, int row) {
    const std::uint32_t stride = static_cast<std::uint32_t>(4 * job.groups);
    const Real* own = job.record + static_cast<std::size_t>(i) * stride;
    Body body{job, i, own};
    int cx = 1;
    while (job.grid.start[job.grid.cell(row, cx) + 1] <= i) ++cx;
    NeighborRun<Real> runs[GridView<Real>::kMaxRuns];
    const int run_count = job.grid.template neighborRuns<kPeriodic>(row, cx, runs);
    DirectSearch<L, kPeriodic>::run(job, runs, run_count, i, stride, [&](const Real*, const std::uint32_t* list, int blocks) {
      addBlocks(job, own, list, blocks, body);
    });
    body.finish(job, i);
  }
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
