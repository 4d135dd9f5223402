// The vector types that passes and effects are written in. Included once per SIMD target (Highway's re-inclusion).
//
//   WideLanes          eight float32 lanes on every wide target, so that sums have the same shape everywhere
//   ScalarLanes<Real>  the twin: one lane, float as oracle, double as reference
#if defined(BLEEDSIM_SPH_PASSES_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BLEEDSIM_SPH_PASSES_LANES_INL_H_
#undef BLEEDSIM_SPH_PASSES_LANES_INL_H_
#else
#define BLEEDSIM_SPH_PASSES_LANES_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <hwy/highway.h>

#include "service/sph/passes/compress_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace bleedsim::sph::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3

struct WideLanes {
  using Scalar = float;
  using Tag = hn::CappedTag<float, 8>;
  using IdTag = hn::Rebind<std::uint32_t, Tag>;
  using V = hn::Vec<Tag>;
  using Ids = hn::Vec<IdTag>;
  using Mask = hn::Mask<Tag>;
  static constexpr int kWidth = 8;

  static V set(float value) { return hn::Set(Tag{}, value); }
  static V load(const float* p) { return hn::Load(Tag{}, p); }
  static V loadUnaligned(const float* p) { return hn::LoadU(Tag{}, p); }
  static void store(V v, float* p) { hn::Store(v, Tag{}, p); }
  static void storeUnaligned(V v, float* p) { hn::StoreU(v, Tag{}, p); }
  static Ids loadIds(const std::uint32_t* p) { return hn::Load(IdTag{}, p); }
  static void storeIds(Ids v, std::uint32_t* p) { hn::StoreU(v, IdTag{}, p); }
  /// first, first + step, first + 2 step, ...
  static Ids idRow(std::uint32_t first, std::uint32_t step) {
    return hn::Add(hn::Set(IdTag{}, first), hn::Mul(hn::Iota(IdTag{}, 0), hn::Set(IdTag{}, step)));
  }
  static Ids setIds(std::uint32_t value) { return hn::Set(IdTag{}, value); }

  static V mulAdd(V a, V b, V c) { return hn::MulAdd(a, b, c); }
  static V subMul(V c, V a, V b) { return hn::NegMulAdd(a, b, c); }  ///< c - a b
  static V max(V a, V b) { return hn::Max(a, b); }
  static V min(V a, V b) { return hn::Min(a, b); }
  static V sqrt(V a) { return hn::Sqrt(a); }
  static V round(V a) { return hn::Round(a); }

  static Mask below(V a, V b) { return hn::Lt(a, b); }
  static V ifBelow(V a, V b, V yes, V no) { return hn::IfThenElse(hn::Lt(a, b), yes, no); }  ///< a < b ? yes : no
  static int countTrue(Mask m) { return static_cast<int>(hn::CountTrue(Tag{}, m)); }
#if HWY_TARGET == HWY_AVX2
  // Highway 1.0.3 holds its table in a local constant, which GCC 12 copies to the stack at each use: 10x slower.
  static auto compressIndices(Mask m) {
    std::uint8_t bits = 0;
    hn::StoreMaskBits(Tag{}, m, &bits);
    const hn::Rebind<std::uint8_t, Tag> bytes;
    const auto lanes = hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(&kCompressLanes[bits]));
    return hn::IndicesFromVec(Tag{}, hn::PromoteTo(hn::Rebind<std::int32_t, Tag>{}, lanes));
  }
  static void compress(V v, Mask m, float* p) { storeUnaligned(hn::TableLookupLanes(v, compressIndices(m)), p); }
  static void compress(Ids v, Mask m, std::uint32_t* p) {
    storeIds(hn::BitCast(IdTag{}, hn::TableLookupLanes(hn::BitCast(Tag{}, v), compressIndices(m))), p);
  }
#else
  /// Writes the lanes under the mask to the front; up to a vector's width of other values behind them.
  static void compress(V v, Mask m, float* p) { storeUnaligned(hn::Compress(v, m), p); }
  static void compress(Ids v, Mask m, std::uint32_t* p) { storeIds(hn::Compress(v, hn::RebindMask(IdTag{}, m)), p); }
#endif

  /// 0 in the first `left` lanes, far away in the others.
  static V tail(std::uint32_t left) {
    alignas(64) static constexpr float kTail[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1e6f, 1e6f, 1e6f, 1e6f, 1e6f, 1e6f, 1e6f, 1e6f};
    return loadUnaligned(kTail + std::max(0, 8 - static_cast<int>(std::min(left, 8u))));
  }

  /// Four consecutive record fields of eight neighbours, one vector a field: 128-bit loads and an in-register transpose.
  static HWY_INLINE void gatherGroup(const float* base, const std::uint32_t* offsets, V* fields) {
    const hn::Half<Tag> half;
    const auto pair = [&](int k) {
      return hn::Combine(Tag{}, hn::Load(half, base + offsets[k + 4]), hn::Load(half, base + offsets[k]));
    };
    transpose(pair(0), pair(1), pair(2), pair(3), fields);
  }

  /// Lane k holds the sum of w[k].
  static V sums(const V* w) {
    const V a = addPairs(addHalves(w[0], w[1]), addHalves(w[2], w[3]));
    const V b = addPairs(addHalves(w[4], w[5]), addHalves(w[6], w[7]));
    return hn::Add(hn::ConcatLowerLower(Tag{}, b, a), hn::ConcatUpperUpper(Tag{}, b, a));
  }
  /// Stores the sums of four vectors.
  static void storeSums(V x, V y, V z, V w, float* p) {
    const V a = addPairs(addHalves(x, y), addHalves(z, w));
    const hn::Half<Tag> half;
    hn::Store(hn::Add(hn::LowerHalf(half, a), hn::UpperHalf(half, a)), half, p);
  }

 private:
  using WideTag = hn::RepartitionToWide<Tag>;
  static V lowerPairs(V a, V b) {
    return hn::BitCast(Tag{}, hn::InterleaveLower(WideTag{}, hn::BitCast(WideTag{}, a), hn::BitCast(WideTag{}, b)));
  }
  static V upperPairs(V a, V b) {
    return hn::BitCast(Tag{}, hn::InterleaveUpper(WideTag{}, hn::BitCast(WideTag{}, a), hn::BitCast(WideTag{}, b)));
  }
  static V addHalves(V a, V b) { return hn::Add(hn::InterleaveLower(Tag{}, a, b), hn::InterleaveUpper(Tag{}, a, b)); }
  static V addPairs(V a, V b) { return hn::Add(lowerPairs(a, b), upperPairs(a, b)); }
  static void transpose(V p, V q, V r, V s, V* fields) {
    const V a = hn::InterleaveLower(Tag{}, p, q);
    const V b = hn::InterleaveUpper(Tag{}, p, q);
    const V c = hn::InterleaveLower(Tag{}, r, s);
    const V d = hn::InterleaveUpper(Tag{}, r, s);
    fields[0] = lowerPairs(a, c);
    fields[1] = upperPairs(a, c);
    fields[2] = lowerPairs(b, d);
    fields[3] = upperPairs(b, d);
  }
};

#else

template <class Real>
struct ScalarLanes {
  using Scalar = Real;
  using V = Real;
  using Ids = std::uint32_t;
  using Mask = bool;
  static constexpr int kWidth = 1;

  static V set(Real value) { return value; }
  static V load(const Real* p) { return *p; }
  static V loadUnaligned(const Real* p) { return *p; }
  static void store(V v, Real* p) { *p = v; }
  static void storeUnaligned(V v, Real* p) { *p = v; }
  static Ids loadIds(const std::uint32_t* p) { return *p; }
  static void storeIds(Ids v, std::uint32_t* p) { *p = v; }
  static Ids idRow(std::uint32_t first, std::uint32_t) { return first; }
  static Ids setIds(std::uint32_t value) { return value; }

  static V mulAdd(V a, V b, V c) { return a * b + c; }
  static V subMul(V c, V a, V b) { return c - a * b; }
  static V max(V a, V b) { return std::max(a, b); }
  static V min(V a, V b) { return std::min(a, b); }
  static V sqrt(V a) { return std::sqrt(a); }
  static V round(V a) { return std::nearbyint(a); }

  static Mask below(V a, V b) { return a < b; }
  static V ifBelow(V a, V b, V yes, V no) { return a < b ? yes : no; }
  static int countTrue(Mask m) { return m ? 1 : 0; }
  static void compress(V v, Mask, Real* p) { *p = v; }
  static void compress(Ids v, Mask, std::uint32_t* p) { *p = v; }
  static V tail(std::uint32_t left) { return left > 0 ? Real(0) : Real(1e6); }

  static HWY_INLINE void gatherGroup(const Real* base, const std::uint32_t* offsets, V* fields) {
    for (int k = 0; k < 4; ++k) fields[k] = base[offsets[0] + static_cast<std::uint32_t>(k)];
  }
  static V sums(const V* w) { return w[0]; }
  static void storeSums(V x, V y, V z, V w, Real* p) {
    p[0] = x;
    p[1] = y;
    p[2] = z;
    p[3] = w;
  }
};

#endif

/// What a target computes float32 in: the baseline target holds the scalar twin.
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
using TargetLanes = WideLanes;
#else
using TargetLanes = ScalarLanes<float>;
#endif

}  // namespace bleedsim::sph::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
