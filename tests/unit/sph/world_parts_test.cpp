// The small parts that a step is made of: time step, hash, arrays, executor, flush-to-zero, seeding.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <vector>

#include "service/sph/aligned_array.h"
#include "service/sph/executor.h"
#include "service/sph/flush_to_zero.h"
#include "service/sph/integrate/time_step.h"
#include "service/sph/seeding.h"
#include "service/sph/share_range.h"
#include "service/sph/view.h"
#include "service/sph/world_setup.h"

namespace bleedsim::sph {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(StableTimeStep, EachLimitBindsWhereItIsTheShortest) {
  const TimeStepLimits limits{.spacing = 0.001, .speed_of_sound = 5.0};
  EXPECT_DOUBLE_EQ(stableTimeStep(limits, 0.0, 0.0, kInfinity), 0.4 * 0.001 / 5.0);
  EXPECT_DOUBLE_EQ(stableTimeStep(limits, 3.0, 0.0, kInfinity), 0.4 * 0.001 / 8.0) << "sound rides on the flow";
  EXPECT_DOUBLE_EQ(stableTimeStep(limits, 0.0, 40'000.0, kInfinity), 0.25 * std::sqrt(0.001 / 40'000.0));
  EXPECT_DOUBLE_EQ(stableTimeStep(limits, 0.0, 10.0, kInfinity), 0.4 * 0.001 / 5.0) << "a gentle push binds nothing";
  TimeStepLimits viscous = limits;
  viscous.viscous = 1e-5;
  EXPECT_DOUBLE_EQ(stableTimeStep(viscous, 0.0, 0.0, kInfinity), 1e-5);
  TimeStepLimits scene = limits;
  scene.scene = 2e-6;
  EXPECT_DOUBLE_EQ(stableTimeStep(scene, 1.0, 10.0, kInfinity), 2e-6);
}

TEST(StableTimeStep, GrowsByATenthAtMost) {
  const TimeStepLimits limits{.spacing = 0.001, .speed_of_sound = 5.0};
  double dt = 1e-6;
  EXPECT_DOUBLE_EQ(stableTimeStep(limits, 0.0, 0.0, dt), 1.1e-6);
  for (int k = 0; k < 100; ++k) dt = stableTimeStep(limits, 0.0, 0.0, dt);
  EXPECT_DOUBLE_EQ(dt, 8e-5) << "and no further than the limits";
  EXPECT_LT(stableTimeStep(limits, 95.0, 0.0, dt), 0.06 * dt) << "a fall is never held back";
}

TEST(StableTimeStep, ViscousLimitIsOfTheThickestBlood) {
  WorldDescription description;
  description.effects.viscosity = ViscositySettings{0.004};
  const double h = description.supportRadius();
  EXPECT_DOUBLE_EQ(timeStepLimits(description, 5.0).viscous, 0.045 * h * h * 1060.0 / 0.004);
  FluidBlock thick;
  thick.viscosity = 0.05;
  description.fluid_blocks.push_back(thick);
  EXPECT_DOUBLE_EQ(timeStepLimits(description, 5.0).viscous, 0.045 * h * h * 1060.0 / 0.05);
  description.effects.viscosity.reset();
  EXPECT_EQ(timeStepLimits(description, 5.0).viscous, kInfinity);
  description.max_dt = 1e-5;
  EXPECT_EQ(timeStepLimits(description, 5.0).scene, 1e-5);
  EXPECT_EQ(timeStepLimits(description, 5.0).speed_of_sound, 5.0);
}

std::uint64_t hashOf(const std::vector<unsigned char>& bytes) {
  StateHash hash;
  hash.addBytes(bytes.data(), bytes.size());
  return hash.value();
}

TEST(StateHashTest, EveryBitCounts) {
  std::vector<unsigned char> bytes(77);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(31 * i);
  const std::uint64_t whole = hashOf(bytes);
  EXPECT_EQ(hashOf(std::vector<unsigned char>{bytes}), whole) << "equal states have equal hashes";
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::vector<unsigned char> flipped = bytes;
      flipped[i] = static_cast<unsigned char>(flipped[i] ^ (1u << bit));
      EXPECT_NE(hashOf(flipped), whole) << "byte " << i << " bit " << bit;
    }
  }
}

TEST(StateHashTest, OrderAndPlaceCount) {
  std::vector<unsigned char> bytes(64, 0);
  for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<unsigned char>(i + 1);
  std::set<std::uint64_t> seen;
  for (std::size_t word = 0; word < 8; ++word) {
    EXPECT_TRUE(seen.insert(hashOf(bytes)).second) << "the same word in place " << word;
    std::rotate(bytes.begin(), bytes.end() - 8, bytes.end());
  }
  StateHash one;
  one.addBytes("abc", 3);
  one.addBytes("def", 3);
  StateHash other;
  other.addBytes("def", 3);
  other.addBytes("abc", 3);
  EXPECT_NE(one.value(), other.value());
  EXPECT_NE(StateHash{}.value(), one.value());
}

class ExecutorShares : public testing::TestWithParam<int> {};

TEST_P(ExecutorShares, EachRunsOnce) {
  const std::unique_ptr<Executor> executor = makeExecutor(GetParam());
  EXPECT_EQ(executor->threads(), GetParam());
  for (const int shares : {0, 1, 2, 3, 7, 64, 200}) {
    std::vector<std::atomic<int>> runs(static_cast<std::size_t>(shares));
    for (int round = 1; round <= 20; ++round) {
      executor->run(shares, [&](int share) { ++runs[static_cast<std::size_t>(share)]; });
      for (const auto& count : runs) ASSERT_EQ(count.load(), round) << "run() came back before its shares were done";
    }
  }
}

TEST_P(ExecutorShares, ComputeWithoutDenormals) {
  const std::unique_ptr<Executor> executor = makeExecutor(GetParam());
  std::vector<float> results(16, 1.0f);
  volatile float small = 2e-38f;
  executor->run(16, [&](int share) { results[static_cast<std::size_t>(share)] = small * 0.25f; });
  for (const float result : results) EXPECT_EQ(result, 0.0f);
}

INSTANTIATE_TEST_SUITE_P(Threads, ExecutorShares, testing::Values(1, 2, 5));

TEST(FlushToZeroTest, ActsForItsLifetimeAndRestores) {
  volatile float small = 2e-38f;
  volatile float quarter = 0.25f;
  ASSERT_GT(small * quarter, 0.0f) << "the test must start with denormals";
  {
    const FlushToZero scope;
    EXPECT_EQ(small * quarter, 0.0f);
    {
      const FlushToZero inner;
      EXPECT_EQ(small * quarter, 0.0f);
    }
    EXPECT_EQ(small * quarter, 0.0f) << "the inner one gave back what it found";
  }
  EXPECT_GT(small * quarter, 0.0f);
}

TEST(ShareRangeTest, CoversEveryParticleOnce) {
  for (const std::uint32_t n : {0u, 1u, 5u, 63u, 4'000'000'000u}) {
    for (const int shares : {1, 2, 3, 64}) {
      std::uint32_t next = 0;
      for (int share = 0; share < shares; ++share) {
        const ShareRange range{n, share, shares};
        ASSERT_EQ(range.begin, next);
        ASSERT_LE(range.end - range.begin, n / static_cast<std::uint32_t>(shares) + 1);
        next = range.end;
      }
      EXPECT_EQ(next, n);
    }
  }
}

TEST(Jitter, IsUniformAndTheSameEverywhere) {
  JitterSource source{1234567};
  // First output of splitmix64 for this seed, 6457827717110365317, in the upper 53 bits.
  EXPECT_DOUBLE_EQ(source.next(), static_cast<double>(6457827717110365317ull >> 11) * 0x1p-52 - 1.0);
  double sum = 0.0;
  double square = 0.0;
  constexpr int kDraws = 100'000;
  for (int k = 0; k < kDraws; ++k) {
    const double value = source.next();
    ASSERT_GE(value, -1.0);
    ASSERT_LT(value, 1.0);
    sum += value;
    square += value * value;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.01);
  EXPECT_NEAR(square / kDraws, 1.0 / 3.0, 0.01);
}

TEST(AlignedArrays, StandOnACacheLineOrOnAHugePage) {
  const auto place = [](const auto& array) { return reinterpret_cast<std::uintptr_t>(array.data()); };
  AlignedArray<float> plain{1000, 7};
  EXPECT_EQ(place(plain) % 64, 0u);
  EXPECT_EQ(plain[999], 0.0f);
  AlignedArray<std::byte> huge{100'000, HugePage{}};
  EXPECT_EQ(place(huge) % (std::size_t{2} << 20), 0u);
  EXPECT_EQ(huge.bytes(), 100'000u);
  std::memset(huge.data(), 0x5a, huge.size() + 64);  // as far as whole vectors write
  AlignedArray<std::byte> other = std::move(huge);
  EXPECT_EQ(other[99'999], std::byte{0x5a});
}

}  // namespace
}  // namespace bleedsim::sph
