// What moves particles four at a time gives the bits of one at a time, whatever is special about one of the four.
#include "service/sph/integrate/kick_drift.h"

#include <cstring>
#include <gtest/gtest.h>
#include <limits>

#include "service/sph/integrate/closing_kick.h"
#include "service/sph/seeding.h"

namespace bleedsim::sph {
namespace {

constexpr std::uint32_t kCount = 41;  // not a multiple of four

template <class Real>
struct Motion {
  Particles<Real> particles{kCount, {}, 0};
  AlignedArray<Real> acceleration{kCount * 4};

  Motion() {
    JitterSource random{11};
    Particles<Real>& p = particles;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      for (AlignedArray<Real>* array : {&p.x, &p.y, &p.z, &p.vx, &p.vy, &p.vz}) (*array)[i] = static_cast<Real>(random.next());
      for (std::uint32_t k = 0; k < 4; ++k) acceleration[4 * i + k] = static_cast<Real>(random.next());
      p.id[i] = i + 1;
    }
  }
};

template <class Real>
bool sameBits(const AlignedArray<Real>& a, const AlignedArray<Real>& b) {
  return std::memcmp(a.data(), b.data(), a.bytes()) == 0;
}

ShareRange only(std::uint32_t i) {
  ShareRange range{kCount, 0, 1};
  range.begin = i;
  range.end = i + 1;
  return range;
}

/// Makes particle `i` special; 7: not at all.
template <class Real>
void makeSpecial(Motion<Real>& motion, std::uint32_t i, int which) {
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
  constexpr Real kNone = std::numeric_limits<Real>::quiet_NaN();
  switch (which) {
    case 0:
      motion.acceleration[4 * i + 1] = kNone;
      break;
    case 1:
      motion.acceleration[4 * i] = -kInfinity;
      break;
    case 2:
      motion.acceleration[4 * i + 3] = kNone;
      break;
    case 3:
      motion.acceleration[4 * i + 2] = Real(60);
      break;
    case 4:
      motion.particles.vy[i] = Real(-30);
      break;
    case 5:
      motion.particles.vz[i] = kNone;
      break;
    case 6:
      motion.acceleration[4 * i + 3] = Real(-0.0);
      break;
    default:
      break;
  }
}

template <class Real>
class KickDrift : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(KickDrift, Reals);

TYPED_TEST(KickDrift, ClosingKickOfFourIsThatOfOne) {
  using Real = TypeParam;
  const MotionCaps<Real> caps{Real(10), Real(50)};
  const std::array<Real, 3> gravity{Real(0.5), Real(0), Real(-9.81)};
  for (std::uint32_t special = 0; special < 8; ++special) {
    for (int which = 0; which < 9; ++which) {
      Motion<Real> four;
      Motion<Real> one;
      for (Motion<Real>* motion : {&four, &one}) {
        makeSpecial(*motion, special, which);
        if (which == 8) motion->particles.driver[special] = 7;
      }
      const KickResult<Real> whole =
          closingKick(four.particles, four.acceleration.data(), gravity, Real(0.125), caps, ShareRange{kCount, 0, 1});
      KickResult<Real> sum;
      for (std::uint32_t i = 0; i < kCount; ++i)
        sum.merge(closingKick(one.particles, one.acceleration.data(), gravity, Real(0.125), caps, only(i)));
      EXPECT_TRUE(sameBits(four.acceleration, one.acceleration)) << special << ' ' << which;
      EXPECT_TRUE(sameBits(four.particles.vx, one.particles.vx)) << special << ' ' << which;
      EXPECT_TRUE(sameBits(four.particles.vy, one.particles.vy)) << special << ' ' << which;
      EXPECT_TRUE(sameBits(four.particles.vz, one.particles.vz)) << special << ' ' << which;
      EXPECT_EQ(whole.max_speed2, sum.max_speed2) << special << ' ' << which;
      EXPECT_EQ(whole.max_acceleration2, sum.max_acceleration2) << special << ' ' << which;
      EXPECT_EQ(whole.speed_clamped, sum.speed_clamped) << special << ' ' << which;
      EXPECT_EQ(whole.acceleration_clamped, sum.acceleration_clamped) << special << ' ' << which;
      EXPECT_EQ(whole.finite, sum.finite) << special << ' ' << which;
      EXPECT_EQ(whole.finite, which > 2 && which != 5) << special << ' ' << which;
    }
  }
}

TYPED_TEST(KickDrift, DriftOfFourIsThatOfOne) {
  using Real = TypeParam;
  WorldDescription description;
  description.domain.lower = {-1.1, -1.1, -1.1};
  description.domain.upper = {1.1, 1.1, 1.1};
  const WoundSet wounds{description, 1.0};
  for (const bool periodic : {false, true}) {
    const DomainBox<Real> box{{Real(-1.1), Real(-1.1), Real(-1.1)}, {Real(1.1), Real(1.1), Real(1.1)}, {periodic, false, false}};
    for (std::uint32_t special = 0; special < 8; ++special) {
      for (int which = 0; which < 8; ++which) {
        Motion<Real> motion;
        makeSpecial(motion, special, which);
        AlignedArray<Real> four{kCount * 4};
        AlignedArray<Real> one{kCount * 4};
        std::array<std::uint32_t, kCount> cells_of_four{};
        std::array<std::uint32_t, kCount> cells_of_one{};
        const auto drift_into = [&](AlignedArray<Real>& moved, std::array<std::uint32_t, kCount>& cells) {
          return Drift<Real>{motion.particles, moved.data(), motion.acceleration.data(), Real(0.01), Real(0.125), 1.0, box,
                             wounds,           cells.data()};
        };
        const DriftResult<Real> whole = drift_into(four, cells_of_four).run(ShareRange{kCount, 0, 1});
        DriftResult<Real> sum;
        for (std::uint32_t i = 0; i < kCount; ++i) {
          const DriftResult<Real> result = drift_into(one, cells_of_one).run(only(i));
          sum.bounds.merge(result.bounds);
          sum.left_domain += result.left_domain;
        }
        EXPECT_EQ(cells_of_four, cells_of_one) << special << ' ' << which;
        EXPECT_EQ(whole.left_domain, sum.left_domain) << special << ' ' << which;
        EXPECT_EQ(whole.bounds.lower, sum.bounds.lower) << special << ' ' << which;
        EXPECT_EQ(whole.bounds.upper, sum.bounds.upper) << special << ' ' << which;
        for (std::uint32_t i = 0; i < kCount; ++i) {
          if (cells_of_one[i] == CellGrid<Real>::kRemoved) continue;
          EXPECT_EQ(std::memcmp(&four[4 * i], &one[4 * i], 3 * sizeof(Real)), 0) << special << ' ' << which << ' ' << i;
        }
      }
    }
  }
}

TYPED_TEST(KickDrift, OpeningKickAndPlacesOfARunAreThoseOfOne) {
  using Real = TypeParam;
  WorldDescription description;
  const WoundSet wounds{description, 1.0};
  for (std::uint32_t length : {1u, 3u, 4u, 11u, 40u}) {
    for (const Real half : {Real(0), Real(0.25)}) {
      Motion<Real> motion;
      makeSpecial(motion, 2, 0);
      Particles<Real> run{kCount, {}, 0};
      Particles<Real> single{kCount, {}, 0};
      kick(run, 1, motion.particles, 0, length, motion.acceleration.data(), half, wounds);
      copyPlaces(run, 1, motion.acceleration.data(), length);
      for (std::uint32_t i = 0; i < length; ++i) {
        kickOne(single, i + 1, motion.particles, i, motion.acceleration.data(), half, wounds);
        copyPlaces(single, i + 1, motion.acceleration.data() + std::size_t{i} * 4, 1);
      }
      for (auto array : {&Particles<Real>::x, &Particles<Real>::y, &Particles<Real>::z, &Particles<Real>::vx,
                         &Particles<Real>::vy, &Particles<Real>::vz}) {
        EXPECT_TRUE(sameBits(run.*array, single.*array)) << length;
      }
    }
  }
}

}  // namespace
}  // namespace bleedsim::sph
