// The neighbours of one particle straight from the cells, for particles without a list: nothing is left out, only time is lost.
//
// Order, distance test and lane of every neighbour are those of the lists, so a sum over the chunks has the bits of a sum over
// the list: which path a particle takes may depend on the thread count, its result may not.
#if defined(BLEEDSIM_SPH_PASSES_DIRECT_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_DIRECT_SEARCH_INL_H_
#undef BLEEDSIM_SPH_PASSES_DIRECT_SEARCH_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_DIRECT_SEARCH_INL_H_
#endif

#include <algorithm>

#include "service/sph/effects/pair_set.h"
#include "service/sph/neighbors/grid_view.h"
#include "service/sph/passes/lanes-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// (r/h)^2 as every pass computes it: the support's edge must be the same to the bit.
template <class L>
HWY_INLINE typename L::V distance2(typename L::V dx, typename L::V dy, typename L::V dz) {
  return L::mulAdd(dz, dz, L::mulAdd(dy, dy, dx * dx));
}

/// How far the list of a particle with this record reaches where it sees others within its own support radius, squared, in h:
/// never less than h, out to which contacts are seen.
template <class Real>
HWY_INLINE Real ownReach2(const Real* record) {
  return std::max(Real(1), Real(1) / (record[kRecordInverseRadius] * record[kRecordInverseRadius]));
}

/// Who gets the neighbours, as a plain function: the search is compiled once, not for every set of effects.
template <class Real>
struct ChunkSink {
  void (*take)(void* taker, const Real* distances, const std::uint32_t* list, int vectors);
  void* taker;
  void operator()(const Real* distances, const std::uint32_t* list, int vectors) const { take(taker, distances, list, vectors); }
};

template <class L, bool kPeriodic>
class DirectSearch {
 public:
  using Real = typename L::Scalar;
  using V = typename L::V;

  /// Calls consume(distances, record offsets, vectors) with the neighbours of particle i nearer than sqrt(reach2), padded to
  /// whole vectors with the far dummy, record `count`, at kFarDistance. `job` has x, y, z and count.
  template <class Job, class Consume>
  HWY_NOINLINE static void run(const Job& job, const NeighborRun<Real>* runs, int run_count, std::uint32_t i,
                               std::uint32_t stride, Real reach2, const Consume& consume) {
    alignas(64) Real q2[kChunk + 2 * kWidth];
    alignas(64) Real distances[kChunk];
    alignas(64) std::uint32_t ids[kChunk + 2 * kWidth];
    int count = 0;
    const V own_x = L::set(job.x[i]);
    const V own_y = L::set(job.y[i]);
    const V own_z = L::set(job.z[i]);
    for (int k = 0; k < run_count; ++k) {
      for (std::uint32_t j = runs[k].begin; j < runs[k].end; j += kWidth) {
        V x = L::loadUnaligned(job.x + j);
        V y = L::loadUnaligned(job.y + j);
        V z = L::loadUnaligned(job.z + j);
        if constexpr (kPeriodic) {
          x = x + L::set(runs[k].shift_x);
          y = y + L::set(runs[k].shift_y);
          z = z + L::set(runs[k].shift_z);
        }
        const V distance = distance2<L>(x - own_x, y - own_y, z - own_z) + L::tail(runs[k].end - j);
        const auto inside = L::below(distance, L::set(reach2));
        L::compress(distance, inside, q2 + count);
        L::compress(L::idRow(j * stride, stride), inside, ids + count);
        count += L::countTrue(inside);
        if (count < kChunk) continue;
        takeRoots(q2, kChunk / kWidth, distances);
        consume(distances, ids, kChunk / kWidth);
        L::store(L::load(q2 + kChunk), q2);
        L::storeIds(L::loadIds(ids + kChunk), ids);
        count -= kChunk;
      }
    }
    L::storeUnaligned(L::set(kFarDistance<Real> * kFarDistance<Real>), q2 + count);
    L::storeIds(L::setIds(job.count * stride), ids + count);
    takeRoots(q2, (count + kWidth - 1) / kWidth, distances);
    consume(distances, ids, (count + kWidth - 1) / kWidth);
  }

  /// The same for a particle of which only the grid's row is known.
  HWY_NOINLINE static void runInRow(const SweepJob<Real>& job, int row, std::uint32_t i, Real reach2,
                                    const ChunkSink<Real>& consume) {
    int cx = 1;
    while (job.grid.start[job.grid.cell(row, cx) + 1] <= i) ++cx;
    NeighborRun<Real> runs[GridView<Real>::kMaxRuns];
    const int run_count = job.grid.template neighborRuns<kPeriodic>(row, cx, runs);
    run(job, runs, run_count, i, static_cast<std::uint32_t>(4 * job.groups), reach2, consume);
  }

 private:
  static void takeRoots(const Real* q2, int vectors, Real* distances) {
    for (int v = 0; v < vectors; ++v) L::store(L::sqrt(L::load(q2 + v * kWidth)), distances + v * kWidth);
  }

  static constexpr int kWidth = L::kWidth;
  static constexpr int kChunk = 128;
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
