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
/// a constructor from (job, i, own record); pair(p); finish(job, i). Where it has needed() and that is false, its neighbours are
/// not walked. Where it has reach2(), its particle's list reaches that far, not job.reach2. Where it has kCompact, one compiled
/// walk serves lists and cells: half the code, for the price of a call and of the body's way through memory. kRadius: the pair's
/// gradient is that of (W(h_i) + W(h_j))/2 with their mass factors, and kGroups covers the radius fields.
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
          const std::size_t at = static_cast<std::size_t>(job.list_at[i]) * L::kWidth;
          particle(job, i, {job.entries + at, job.distances + at, job.blocks[i]});
        } else {
          particleWithoutList(job, i, row);
        }
      }
    }
  }

 private:
  static constexpr int kGroups = kRadius && Body::kGroups < 3 ? 3 : Body::kGroups;

  struct List {
    const std::uint32_t* entries;
    const Real* distances;
    int blocks;  // vectors
  };

  HWY_INLINE static bool isNeeded(const Body& body) {
    if constexpr (requires { body.needed(); })
      return body.needed();
    else
      return true;
  }

  static void particle(const Job& job, std::uint32_t i, List list) {
    const Real* own = job.record + static_cast<std::size_t>(i) * static_cast<std::uint32_t>(4 * job.groups);
    Body body{job, i, own};
    if (isNeeded(body)) walk(job, own, list, body);
    body.finish(job, i);
  }

  HWY_INLINE static void walk(const Job& job, const Real* own, List list, Body& body) {
    if constexpr (requires { Body::kCompact; })
      addBlocksApart(job, own, list, body);
    else
      addBlocks(job, own, list, body);
  }

  HWY_NOINLINE static void addBlocksApart(const Job& job, const Real* own, List list, Body& body) {
    Body in_registers = body;
    addBlocks(job, own, list, in_registers);
    body = in_registers;
  }

  HWY_INLINE static void addBlocks(const Job& job, const Real* own, List list, Body& body) {
    const V x = L::set(own[kRecordX]);
    const V y = L::set(own[kRecordY]);
    const V z = L::set(own[kRecordZ]);
    [[maybe_unused]] V own_inverse, own_factor;
    if constexpr (kRadius) {
      own_inverse = L::set(own[kRecordInverseRadius]);
      own_factor = L::set(Real(0.5) * own[kRecordRadiusFactor] * own[kRecordInverseRadius] * own[kRecordInverseRadius]);
    }
    for (; list.blocks > 0; --list.blocks, list.entries += L::kWidth, list.distances += L::kWidth) {
      Pair<L> p;
      gatherGroups(job.record, list.entries, p.field);
      p.dx = p.field[kRecordX] - x;
      p.dy = p.field[kRecordY] - y;
      p.dz = p.field[kRecordZ] - z;
      if constexpr (kPeriodic) {
        p.dx = nearest(p.dx, job.grid.periodic[0], job.grid.period[0]);
        p.dy = nearest(p.dy, job.grid.periodic[1], job.grid.period[1]);
        p.dz = nearest(p.dz, job.grid.periodic[2], job.grid.period[2]);
      }
      p.q = L::load(list.distances);
      p.q2 = p.q * p.q;
      p.list = list.entries;
      if constexpr (kRadius) {
        const V inverse = p.field[kRecordInverseRadius];
        const V factor = L::set(Real(0.5)) * p.field[kRecordRadiusFactor] * (inverse * inverse);
        p.gradient = L::mulAdd(own_factor, Kernel::gradient(p.q * own_inverse), factor * Kernel::gradient(p.q * inverse));
      } else {
        p.gradient = Kernel::gradient(p.q);
      }
      body.pair(p);
    }
  }

  /// Written out: as a loop the compiler may keep it, and with it the fields in memory.
  HWY_INLINE static void gatherGroups(const Real* record, const std::uint32_t* list, V* field) {
    static_assert(kGroups >= 1 && kGroups <= 4);
    L::gatherGroup(record, list, field);
    if constexpr (kGroups > 1) L::gatherGroup(record + 4, list, field + 4);
    if constexpr (kGroups > 2) L::gatherGroup(record + 8, list, field + 8);
    if constexpr (kGroups > 3) L::gatherGroup(record + 12, list, field + 12);
  }

  /// The minimum image; at most one period is taken off, so that the far dummy stays far.
  static V nearest(V d, bool periodic, Real period) {
    if (!periodic) return d;
    const V image = L::max(L::min(L::round(d * L::set(Real(1) / period)), L::set(Real(1))), L::set(Real(-1)));
    return L::subMul(d, image, L::set(period));
  }

  struct Apart {
    const Job* job;
    const Real* own;
    Body* body;
  };
  static void addChunk(void* taker, const Real* distances, const std::uint32_t* list, int blocks) {
    const Apart& apart = *static_cast<const Apart*>(taker);
    walk(*apart.job, apart.own, {list, distances, blocks}, *apart.body);
  }

  /// A particle without a list: its neighbours come straight from the cells.
  static void particleWithoutList(const Job& job, std::uint32_t i, int row) {
    const Real* own = job.record + static_cast<std::size_t>(i) * static_cast<std::uint32_t>(4 * job.groups);
    Body body{job, i, own};
    if (!isNeeded(body)) {
      body.finish(job, i);
      return;
    }
    Real reach2 = job.reach2;
    if constexpr (requires { body.reach2(); }) reach2 = body.reach2();
    Apart apart{&job, own, &body};
    DirectSearch<L, kPeriodic>::runInRow(job, row, i, reach2, {&addChunk, &apart});
    body.finish(job, i);
  }
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
