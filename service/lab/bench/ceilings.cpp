// The kernels are compiled for every SIMD target; the best of this machine runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "service/lab/bench/ceilings.cpp"
#include <cstddef>
#include <cstdint>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bleedsim::lab::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::ScalableTag<float>;

/// Twelve chains hide the latency of a multiply-add on two ports. Returns the operations; `sink` keeps the result alive.
double multiplyAdds(std::uint64_t rounds, float* sink) {
  const Lanes d;
  const auto factor = hn::Set(d, 0.999F);
  const auto add = hn::Set(d, 1e-3F);
  auto c0 = hn::Set(d, 1.0F), c1 = hn::Set(d, 1.1F), c2 = hn::Set(d, 1.2F), c3 = hn::Set(d, 1.3F);
  auto c4 = hn::Set(d, 1.4F), c5 = hn::Set(d, 1.5F), c6 = hn::Set(d, 1.6F), c7 = hn::Set(d, 1.7F);
  auto c8 = hn::Set(d, 1.8F), c9 = hn::Set(d, 1.9F), c10 = hn::Set(d, 2.0F), c11 = hn::Set(d, 2.1F);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    c0 = hn::MulAdd(c0, factor, add);
    c1 = hn::MulAdd(c1, factor, add);
    c2 = hn::MulAdd(c2, factor, add);
    c3 = hn::MulAdd(c3, factor, add);
    c4 = hn::MulAdd(c4, factor, add);
    c5 = hn::MulAdd(c5, factor, add);
    c6 = hn::MulAdd(c6, factor, add);
    c7 = hn::MulAdd(c7, factor, add);
    c8 = hn::MulAdd(c8, factor, add);
    c9 = hn::MulAdd(c9, factor, add);
    c10 = hn::MulAdd(c10, factor, add);
    c11 = hn::MulAdd(c11, factor, add);
  }
  const auto sum = ((c0 + c1) + (c2 + c3)) + ((c4 + c5) + (c6 + c7)) + ((c8 + c9) + (c10 + c11));
  *sink = hn::GetLane(sum);
  return 2.0 * 12.0 * static_cast<double>(hn::Lanes(d)) * static_cast<double>(rounds);
}

void triad(float* a, const float* b, const float* c, std::size_t count) {
  const Lanes d;
  const auto scale = hn::Set(d, 3.0F);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(hn::MulAdd(hn::LoadU(d, c + i), scale, hn::LoadU(d, b + i)), d, a + i);
}

}  // namespace
}  // namespace bleedsim::lab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <chrono>
#include <vector>

#include "service/lab/bench/ceilings.h"
#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"

namespace bleedsim::lab {

HWY_EXPORT(multiplyAdds);
HWY_EXPORT(triad);

namespace {

constexpr std::uint64_t kRounds = 1'000'000;
constexpr std::size_t kVector = 16;  // elements of the widest vectors

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

struct Ceilings::Arrays {
  std::unique_ptr<sph::Executor> executor;
  std::size_t each;  // elements of a thread
  sph::AlignedArray<float> a, b, c;
  std::vector<float> sinks;
};

Ceilings::Ceilings(int threads, std::size_t elements) {
  const auto count = static_cast<std::size_t>(threads);
  const std::size_t each = (elements / count + kVector - 1) / kVector * kVector;
  const auto room = [&](unsigned lane) { return sph::AlignedArray<float>{each * count, lane, sph::Uninitialized{}}; };
  arrays_ = std::make_unique<Arrays>(
      Arrays{sph::makeExecutor(threads), each, room(0), room(1), room(2), std::vector<float>(count * kVector)});
  arrays_->executor->run(threads, [this](int share) {
    const std::size_t begin = static_cast<std::size_t>(share) * arrays_->each;
    for (std::size_t i = begin; i < begin + arrays_->each; ++i) {
      arrays_->a[i] = 0.0F;
      arrays_->b[i] = 1.0F;
      arrays_->c[i] = 2.0F;
    }
  });
}

Ceilings::~Ceilings() = default;
Ceilings::Ceilings(Ceilings&&) noexcept = default;

Ceiling Ceilings::measure() {
  Arrays& arrays = *arrays_;
  const int threads = arrays.executor->threads();
  std::vector<double> operations(static_cast<std::size_t>(threads));
  Ceiling ceiling;
  const double start = now();
  arrays.executor->run(threads, [&](int share) {
    const auto s = static_cast<std::size_t>(share);
    operations[s] = HWY_DYNAMIC_DISPATCH(multiplyAdds)(kRounds, &arrays.sinks[s * kVector]);
  });
  const double middle = now();
  arrays.executor->run(threads, [&](int share) {
    const std::size_t begin = static_cast<std::size_t>(share) * arrays.each;
    HWY_DYNAMIC_DISPATCH(triad)
    (arrays.a.data() + begin, arrays.b.data() + begin, arrays.c.data() + begin, arrays.each);
  });
  const double end = now();
  double sum = 0.0;
  for (const double one : operations) sum += one;
  ceiling.gflops = 1e-9 * sum / (middle - start);
  ceiling.gigabytes_s = 1e-9 * 12.0 * static_cast<double>(arrays.a.size()) / (end - middle);
  return ceiling;
}

}  // namespace bleedsim::lab
#endif
