// Density (20), the equation of state (19) and the neighbour lists, cell by cell.
//
// The particles of the 27 cells around a cell are culled against the box of the cell's own particles into a buffer that stays in
// the first-level cache. Two particles at a time test the buffer; hits (squared distance, record offset) are compressed into
// lists, padded to whole vectors with a far dummy, so that the force pass needs no masks. A pair's kernels are evaluated once
// the next pair has been searched.
#if defined(BLEEDSIM_SPH_PASSES_DENSITY_PASS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_DENSITY_PASS_INL_H_
#undef BLEEDSIM_SPH_PASSES_DENSITY_PASS_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_DENSITY_PASS_INL_H_
#endif

#include <algorithm>
#include <hwy/cache_control.h>
#include <new>
#include <type_traits>

#include "service/sph/effects/pair_set.h"
#include "service/sph/passes/direct_search-inl.h"
#include "service/sph/passes/kernels-inl.h"
#include "service/sph/passes/pass_jobs.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {

/// kRadius: whose support radius a pair is weighed with. mean: (W(h_i) + W(h_j))/2, each W with its lattice's mass factor, and
/// a list has those within the larger radius of the two, never less than h. own: W(h_i), and a list reaches as far as
/// ownReach2().
template <class L, template <class> class KernelOf, bool kPeriodic, bool kTissue, SupportRadius kRadius>
class DensityPass {
 public:
  using Real = typename L::Scalar;
  using V = typename L::V;
  using Kernel = KernelOf<L>;

  static void run(DensityJob<Real>& job) {
    static_assert(sizeof(DensityPass) <= kDensityRoom<Real> && std::is_trivially_destructible_v<DensityPass>);
    DensityPass& pass = *::new (job.room) DensityPass{job};
    for (int row = job.row_begin; row < job.row_end; ++row) {
      if (job.grid.rowBegin(row) != job.grid.rowEnd(row)) pass.sweepRow(row);
    }
  }

 private:
  static constexpr int kWidth = L::kWidth;
  static constexpr std::uint32_t kBatch = 64;  // particles whose hits are kept at once
  static constexpr int kMaxCandidates = 2048;
  static constexpr int kMaxBlocks = kMaxCandidates / kWidth + 4 * GridView<Real>::kMaxRuns;
  static constexpr int kListLimit = kMaxNeighbors - 2 * kWidth;  // room for one more vector of hits and the padding

  struct Hits {
    Real* q2;
    std::uint32_t* ids;
    int count;
  };

  explicit DensityPass(DensityJob<Real>& job) : job_{job}, stride_{static_cast<std::uint32_t>(4 * job.groups)} {}

  /// Squared search radius in support radii, a constant of the program where it is 1: of all, and of one particle.
  V reach2() const { return L::set(kRadius == SupportRadius::common ? Real(1) : job_.reach2); }
  Real reach2Of([[maybe_unused]] std::uint32_t i) const {
    if constexpr (kRadius == SupportRadius::common)
      return Real(1);
    else if constexpr (kRadius == SupportRadius::mean)
      return std::max(Real(1), job_.radius[i] * job_.radius[i]);
    else
      return ownReach2(job_.record + static_cast<std::size_t>(i) * stride_);
  }
  /// How far a vector of candidates reaches, where they count.
  HWY_INLINE V pairReach2(V own, [[maybe_unused]] int candidates) const {
    if constexpr (kRadius == SupportRadius::mean)
      return L::max(own, L::load(reach2_ + candidates));
    else
      return own;
  }

  void sweepRow(int row) {
    const std::uint32_t* start = job_.grid.start;
    for (int cx = 1; cx < job_.grid.size[0] - 1; ++cx) {
      const std::size_t cell = job_.grid.cell(row, cx);
      const std::uint32_t begin = start[cell];
      const std::uint32_t end = start[cell + 1];
      if (begin == end) continue;
      NeighborRun<Real> runs[GridView<Real>::kMaxRuns];
      const int run_count = job_.grid.template neighborRuns<kPeriodic>(row, cx, runs);
      fetchAhead(runs, run_count);
      if (!gatherCandidates(runs, run_count, begin, end)) {
        for (std::uint32_t i = begin; i < end; ++i) sumDirectly(runs, run_count, i);
        continue;
      }
      for (std::uint32_t i = begin; i < end; i += kBatch) sweepBatch(runs, run_count, i, std::min(kBatch, end - i));
    }
  }

  /// Asks for the places that later cells of the row will read: the processor does not guess nine or more streams at once.
  HWY_INLINE void fetchAhead(const NeighborRun<Real>* runs, int run_count) const {
    constexpr std::uint32_t kAhead = 32;  // particles, some four cells
    for (int k = 0; k < run_count; ++k) {
      const std::uint32_t j = std::min(runs[k].end + kAhead, job_.count - 1);
      hwy::Prefetch(job_.x + j);
      hwy::Prefetch(job_.y + j);
      hwy::Prefetch(job_.z + j);
    }
  }

  /// Fills the candidate buffer; false when the cells hold too many.
  HWY_INLINE bool gatherCandidates(const NeighborRun<Real>* runs, int run_count, std::uint32_t begin, std::uint32_t end) {
    at_rest_ = false;
    std::uint32_t total = 0;
    for (int k = 0; k < run_count; ++k) total += runs[k].end - runs[k].begin;
    if (total > static_cast<std::uint32_t>(kMaxCandidates - kWidth * GridView<Real>::kMaxRuns)) return false;

    const Real* const position[3] = {job_.x, job_.y, job_.z};
    V lower[3], upper[3];
    for (int a = 0; a < 3; ++a) {
      Real low = position[a][begin];
      Real high = low;
      for (std::uint32_t i = begin + 1; i < end; ++i) {
        low = std::min(low, position[a][i]);
        high = std::max(high, position[a][i]);
      }
      lower[a] = L::set(low);
      upper[a] = L::set(high);
    }

    // Vectors of candidates first: four of each run are written without a branch, which a row seldom exceeds.
    int blocks = 0;
    for (int k = 0; k < run_count; ++k) {
      const std::uint32_t length = runs[k].end - runs[k].begin;
      const int needed = static_cast<int>((length + kWidth - 1) / kWidth);
      for (int b = 0; b < 4; ++b) setBlock(blocks + b, runs[k], k, b);
      for (int b = 4; b < needed; ++b) setBlock(blocks + b, runs[k], k, b);
      blocks += needed;
    }

    int count = 0;
    V reach = reach2();
    if constexpr (kRadius == SupportRadius::mean) {
      Real largest = Real(1);
      for (std::uint32_t i = begin; i < end; ++i) largest = std::max(largest, job_.radius[i]);
      reach = L::set(largest * largest);
    }
    // What the loop reads of the job stands in locals: its stores could change members, for all that the compiler knows.
    const Real* const xs = position[0];
    const Real* const ys = position[1];
    const Real* const zs = position[2];
    [[maybe_unused]] const Real* const radii = job_.radius;
    [[maybe_unused]] V least = L::set(Real(1));
    [[maybe_unused]] V most = least;
    const std::uint32_t stride = stride_;
    const auto steps = L::idRow(0, stride);
    for (int b = 0; b < blocks; ++b) {
      const std::uint32_t j = block_begin_[b];
      V x = L::loadUnaligned(xs + j);
      V y = L::loadUnaligned(ys + j);
      V z = L::loadUnaligned(zs + j);
      if constexpr (kPeriodic) {
        const NeighborRun<Real>& run = runs[block_run_[b]];
        x = x + L::set(run.shift_x);
        y = y + L::set(run.shift_y);
        z = z + L::set(run.shift_z);
      }
      const V dx = x - L::min(L::max(x, lower[0]), upper[0]);
      const V dy = y - L::min(L::max(y, lower[1]), upper[1]);
      const V dz = z - L::min(L::max(z, lower[2]), upper[2]);
      V q2 = L::mulAdd(dx, dx, L::tail(block_end_[b] - j));
      q2 = L::mulAdd(dz, dz, L::mulAdd(dy, dy, q2));
      V pair_reach = reach;
      [[maybe_unused]] V own_reach;
      if constexpr (kRadius == SupportRadius::mean) {
        const V radius = L::loadUnaligned(radii + j);
        least = L::min(least, radius);
        most = L::max(most, radius);
        own_reach = radius * radius;
        pair_reach = L::max(reach, own_reach);
      }
      const auto near = L::below(q2, pair_reach);
      if constexpr (kRadius == SupportRadius::mean) L::compress(own_reach, near, reach2_ + count);
      L::compress(x, near, x_ + count);
      L::compress(y, near, y_ + count);
      L::compress(z, near, z_ + count);
      L::compress(L::setIds(j * stride) + steps, near, ids_ + count);
      count += L::countTrue(near);
    }
    // What fills the last vector is out of reach, whatever the other coordinates there are.
    L::storeUnaligned(L::set(Real(1e6)), x_ + count);
    if constexpr (kRadius == SupportRadius::mean) L::storeUnaligned(L::set(Real(0)), reach2_ + count);
    candidates_ = count;
    if constexpr (kRadius == SupportRadius::mean) at_rest_ = L::countTrue(L::below(least, most)) == 0;
    return true;
  }

  void setBlock(int at, const NeighborRun<Real>& run, int run_index, int b) {
    block_begin_[at] = run.begin + static_cast<std::uint32_t>(b * kWidth);
    block_end_[at] = run.end;
    if constexpr (kPeriodic) block_run_[at] = static_cast<std::uint8_t>(run_index);
  }

  void take(Hits& hits, V q2, typename L::Ids ids, V reach) const {
    const auto inside = L::below(q2, reach);
    L::compress(q2, inside, hits.q2 + hits.count);
    L::compress(ids, inside, hits.ids + hits.count);
    hits.count += L::countTrue(inside);
  }

  void sweepBatch(const NeighborRun<Real>* runs, int run_count, std::uint32_t first, std::uint32_t size) {
    std::uint64_t overflowed = 0;  // bit per particle
    for (std::uint32_t k = 0; k < size + 2; k += 2) {
      if (k < size) overflowed |= searchPair(first + k, k, k + 1 < size) << k;
      if (k > 0) weighPair(first, k - 2);
    }
    finishBatch(first, size);
    if (overflowed == 0) return;
    for (std::uint32_t k = 0; k < size; ++k) {
      if (overflowed >> k & 1) sumDirectly(runs, run_count, first + k);
    }
  }

  /// Lists of particle i, the batch's k-th, and of the one behind it if there are two; the second one's entries are left apart.
  /// Bits of those that get none, for they overflow or the room is full.
  HWY_INLINE std::uint64_t searchPair(std::uint32_t i, std::uint32_t k, bool two) {
    lengths_[k] = lengths_[k + 1] = 0;
    if (job_.lists->used + 2 * kMaxNeighbors > job_.lists->end && !job_.lists->goOn()) return two ? 3 : 1;
    Hits a{q2_ + kMaxNeighbors * k, job_.lists->entries + job_.lists->used, 0};
    Hits b{q2_ + kMaxNeighbors * (k + 1), second_ids_[k / 2 % 2], 0};
    std::uint64_t overflowed = 0;
    const bool fit = two ? searchTwo(i, a, b) : searchOne(i, a);
    if (!fit && two) {  // one of them overflows: each on its own
      a.count = b.count = 0;
      if (!searchOne(i, a)) overflowed |= 1;
      if (!searchOne(i + 1, b)) overflowed |= 2;
    } else if (!fit) {
      overflowed |= 1;
    }
    if (!(overflowed & 1)) lengths_[k] = closeList(i, a);
    if (two && !(overflowed & 2)) lengths_[k + 1] = closeList(i + 1, b);
    return overflowed;
  }

  bool searchOne(std::uint32_t i, Hits& hits) const {
    const V x = L::set(job_.x[i]);
    const V y = L::set(job_.y[i]);
    const V z = L::set(job_.z[i]);
    const V reach = L::set(reach2Of(i));
    for (int c = 0; c < candidates_; c += kWidth) {
      take(hits, distance2<L>(L::load(x_ + c) - x, L::load(y_ + c) - y, L::load(z_ + c) - z), L::loadIds(ids_ + c),
           pairReach2(reach, c));
      if (hits.count > kListLimit) return false;
    }
    return true;
  }
  HWY_INLINE bool searchTwo(std::uint32_t i, Hits& a, Hits& b) const {
    const V x0 = L::set(job_.x[i]);
    const V y0 = L::set(job_.y[i]);
    const V z0 = L::set(job_.z[i]);
    const V x1 = L::set(job_.x[i + 1]);
    const V y1 = L::set(job_.y[i + 1]);
    const V z1 = L::set(job_.z[i + 1]);
    const V reach0 = L::set(reach2Of(i));
    const V reach1 = L::set(reach2Of(i + 1));
    for (int c = 0; c < candidates_; c += kWidth) {
      const V x = L::load(x_ + c);
      const V y = L::load(y_ + c);
      const V z = L::load(z_ + c);
      const auto ids = L::loadIds(ids_ + c);
      take(a, distance2<L>(x - x0, y - y0, z - z0), ids, pairReach2(reach0, c));
      take(b, distance2<L>(x - x1, y - y1, z - z1), ids, pairReach2(reach1, c));
      if (std::max(a.count, b.count) > kListLimit) return false;
    }
    return true;
  }

  /// Pads the list to whole vectors and records where it is; returns its length in vectors.
  HWY_INLINE int closeList(std::uint32_t i, Hits& hits) {
    L::storeUnaligned(L::set(kFarDistance<Real> * kFarDistance<Real>), hits.q2 + hits.count);
    L::storeIds(L::setIds(job_.count * stride_), hits.ids + hits.count);
    const int length = (hits.count + kWidth - 1) / kWidth;
    job_.blocks[i] = static_cast<std::uint8_t>(length);
    job_.list_at[i] = static_cast<std::uint32_t>(job_.lists->used / kWidth);
    job_.lists->used += static_cast<std::size_t>(length * kWidth);
    return length;
  }

  /// Puts the second list of a pair behind the first one and weighs both. Only once the next pair has been searched: read right
  /// after they were written, in pieces that are no vectors, lists wait for the cache, and the roots run beside the search.
  HWY_INLINE void weighPair(std::uint32_t first, std::uint32_t k) {
    if (lengths_[k + 1] > 0) {
      const std::uint32_t* const from = second_ids_[k / 2 % 2];
      std::uint32_t* const to = job_.lists->entries + static_cast<std::size_t>(job_.list_at[first + k + 1]) * kWidth;
      for (int v = 0; v < lengths_[k + 1]; ++v) L::storeIds(L::loadIds(from + v * kWidth), to + v * kWidth);
    }
    for (std::uint32_t m = k; m < k + 2; ++m) weigh(first, m);
  }

  HWY_INLINE void weigh(std::uint32_t first, std::uint32_t k) {
    V sum = L::set(Real(0));
    if (lengths_[k] > 0) {
      const std::size_t at = static_cast<std::size_t>(job_.list_at[first + k]) * kWidth;
      const Real* const q2 = q2_ + kMaxNeighbors * k;
      Real* const distances = job_.lists->distances + at;
      const auto distance = [&](int v) {
        const V q = L::sqrt(L::load(q2 + v * kWidth));
        L::store(q, distances + v * kWidth);
        return q;
      };
      addWeights(first + k, distance, job_.lists->entries + at, lengths_[k], sum);
    }
    L::store(sum, sums_ + k * kWidth);
  }

  HWY_INLINE void finishBatch(std::uint32_t first, std::uint32_t size) {
    for (std::uint32_t k = 0; k < size; k += kWidth) {
      V rows[kWidth];
      for (int r = 0; r < kWidth; ++r) rows[r] = L::load(sums_ + (k + static_cast<std::uint32_t>(r)) * kWidth);
      finish(first + k, std::min<std::uint32_t>(kWidth, size - k), L::sums(rows));
    }
  }

  /// Densities and pressures of `count` particles, at most a vector, from their weights.
  HWY_INLINE void finish(std::uint32_t first, std::uint32_t count, V weights) const {
    V density = L::set(job_.mass_weight) * weights;
    if constexpr (kTissue) density = density + L::set(job_.rest_density) * L::loadUnaligned(job_.share + first);
    const V inverse = L::set(Real(1)) / density;
    const V floor = L::set(job_.pressure_floor);
    const V state = L::set(job_.background) + L::set(job_.stiffness) * (density - L::set(job_.rest_density));
    const V pressure = L::ifBelow(floor, state, state, floor);
    const V term = L::set(job_.pressure_scale) * pressure * (job_.symmetric ? L::set(Real(0.5)) : inverse * inverse);
    alignas(64) Real densities[kWidth];
    alignas(64) Real inverses[kWidth];
    alignas(64) Real terms[kWidth];
    L::store(density, densities);
    L::store(inverse, inverses);
    L::store(term, terms);
    const bool has_pressure = job_.pressure_scale != Real(0);
    const bool has_inverse = job_.groups > 1;
    Real* record = job_.record + static_cast<std::size_t>(first) * stride_;
    for (std::uint32_t r = 0; r < count; ++r, record += stride_) {
      if (has_pressure) record[kRecordPressure] = terms[r];
      if (has_inverse) record[kRecordInverseDensity] = inverses[r];
      job_.density[first + r] = densities[r];
    }
  }

  /// The path of a particle without a list: it has too many neighbours, or there is no room for more lists.
  void sumDirectly(const NeighborRun<Real>* runs, int run_count, std::uint32_t i) {
    V rows[kWidth];
    for (int r = 0; r < kWidth; ++r) rows[r] = L::set(Real(0));
    V sum = L::set(Real(0));
    DirectSearch<L, kPeriodic>::run(job_, runs, run_count, i, stride_, reach2Of(i),
                                    [&](const Real* distances, const std::uint32_t* list, int vectors) {
                                      addWeights(
                                          i, [&](int v) { return L::load(distances + v * kWidth); }, list, vectors, sum);
                                    });
    rows[0] = sum;
    job_.blocks[i] = kOverflowList;
    ++job_.overflowed;
    finish(i, 1, L::sums(rows));
  }

  /// `distance` gives the distances of a vector of the list, by its number.
  template <class Distance>
  HWY_INLINE void addWeights([[maybe_unused]] std::uint32_t i, const Distance& distance,
                             [[maybe_unused]] const std::uint32_t* list, int vectors, V& sum) const {
    if (kRadius == SupportRadius::common || (kRadius == SupportRadius::mean && at_rest_)) {
      for (int v = 0; v < vectors; ++v) sum = sum + Kernel::weight(distance(v));
      return;
    }
    const Real* own = job_.record + static_cast<std::size_t>(i) * stride_;
    const V own_inverse = L::set(own[kRecordInverseRadius]);
    const V own_factor = L::set(own[kRecordRadiusFactor]);
    if constexpr (kRadius == SupportRadius::own) {
      for (int v = 0; v < vectors; ++v) sum = L::mulAdd(own_factor, Kernel::weight(distance(v) * own_inverse), sum);
    } else if constexpr (kRadius == SupportRadius::mean) {
      for (int v = 0; v < vectors; ++v, list += kWidth) {
        const V q = distance(v);
        V field[4];
        L::gatherGroup(job_.record + kRecordInverseViscosity, list, field);
        const V inverse = field[kRecordInverseRadius - kRecordInverseViscosity];
        const V factor = field[kRecordRadiusFactor - kRecordInverseViscosity];
        const V both = L::mulAdd(own_factor, Kernel::weight(q * own_inverse), factor * Kernel::weight(q * inverse));
        sum = L::mulAdd(L::set(Real(0.5)), both, sum);
      }
    }
  }

  // The candidates' arrays are read side by side: a quarter of a page apart they keep out of each other's cache sets.
  static constexpr int kCandidateRoom = kMaxCandidates + 1024 / static_cast<int>(sizeof(Real));
  alignas(4096) Real x_[kCandidateRoom];
  Real y_[kCandidateRoom];
  Real z_[kCandidateRoom];
  alignas(64) std::uint32_t ids_[kCandidateRoom];
  alignas(64) Real reach2_[kRadius == SupportRadius::mean ? kCandidateRoom : 1];
  alignas(64) Real q2_[kBatch * kMaxNeighbors];
  alignas(64) Real sums_[(kBatch + 8) * kWidth] = {};
  alignas(64) std::uint32_t second_ids_[2][kMaxNeighbors];
  std::uint32_t block_begin_[kMaxBlocks];
  std::uint32_t block_end_[kMaxBlocks];
  std::uint8_t block_run_[kMaxBlocks];
  int lengths_[kBatch + 8] = {};
  DensityJob<Real>& job_;
  const std::uint32_t stride_;
  int candidates_ = 0;
  bool at_rest_ = false;  // all radii around the cell are h: the mean of both kernels is either one, to the bit
};

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
