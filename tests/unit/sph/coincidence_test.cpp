// Particles on one spot are set apart: neighbors/coincidence.h.
#include "service/sph/neighbors/coincidence.h"

#include <gtest/gtest.h>
#include <memory>

#include "service/sph/world_description.h"

namespace bleedsim::sph {
namespace {

constexpr double kSpacingPerRadius = 0.5;
constexpr double kShift = 1e-3 * kSpacingPerRadius;

Vec3 directionOf(std::uint32_t a, std::uint32_t b, bool planar = false) {
  const std::array<double, 3> d = partingDirection<double>(a, b, planar);
  return {d[0], d[1], d[2]};
}

TEST(PartingDirection, IsAUnitVectorThatTurnsWithTheOrder) {
  Vec3 mean = Vec3::Zero();
  for (std::uint32_t a = 1; a <= 40; ++a) {
    for (std::uint32_t b = a + 1; b <= 40; ++b) {
      const Vec3 there = directionOf(a, b);
      EXPECT_NEAR(there.norm(), 1.0, 1e-12);
      EXPECT_EQ(there, -directionOf(b, a));
      EXPECT_NEAR(directionOf(a, b, true).norm(), 1.0, 1e-12);
      EXPECT_EQ(directionOf(a, b, true).z(), 0.0);
      mean += there / 780.0;
    }
  }
  EXPECT_LT(mean.norm(), 0.15) << "780 directions all round: 3 standard deviations of their mean are 3/sqrt(780) = 0.11";
}

/// Particles at positions in support radii; ids as in the list, from 1.
class Spots {
 public:
  explicit Spots(const std::vector<Vec3>& places, bool planar = false)
      : count_{static_cast<std::uint32_t>(places.size())},
        placed_{count_, {}, 0},
        particles_{count_, {}, Particles<double>::kArrays},
        grid_{count_, {-4, -4, -4}, {4, 4, 4}, {}, 0.0, 1},
        coincidence_{kSpacingPerRadius, planar, 1},
        executor_{makeExecutor(1)} {
    Bounds<double> bounds;
    for (std::uint32_t i = 0; i < count_; ++i) {
      placed_.x[i] = places[i].x();
      placed_.y[i] = places[i].y();
      placed_.z[i] = places[i].z();
      placed_.id[i] = i + 1;
      placed_.driver[i] = 0;
      bounds.include(placed_.x[i], placed_.y[i], placed_.z[i]);
    }
    grid_.cover(bounds);
  }

  void drive(std::uint32_t id) { placed_.driver[id - 1] = 1; }

  std::uint64_t part() {
    for (std::uint32_t i = 0; i < count_; ++i) grid_.cells()[i] = grid_.cellAt(placed_.x[i], placed_.y[i], placed_.z[i]);
    grid_.sort(count_, 1, *executor_, [&](std::uint32_t from, std::uint32_t to) { particles_.copyOne(to, placed_, from); });
    return coincidence_.part(grid_, particles_, count_, 1, *executor_);
  }

  Vec3 at(std::uint32_t id) const {
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (particles_.id[i] == id) return {particles_.x[i], particles_.y[i], particles_.z[i]};
    }
    ADD_FAILURE() << "no particle " << id;
    return Vec3::Zero();
  }

 private:
  std::uint32_t count_;
  Particles<double> placed_, particles_;
  CellGrid<double> grid_;
  Coincidence<double> coincidence_;
  std::unique_ptr<Executor> executor_;
};

TEST(Coincidence, TwoGoOppositeWaysFromWhereTheyStood) {
  const Vec3 spot{0.3, -0.7, 0.2};
  const Vec3 other{0.3, -0.7, 0.2 + 1e-5};
  Spots spots{{spot, other, spot}};
  EXPECT_EQ(spots.part(), 2u);
  EXPECT_LT((spots.at(1) - spot - kShift * directionOf(1, 3)).norm(), 1e-15);
  EXPECT_LT((spots.at(3) - spot - kShift * directionOf(3, 1)).norm(), 1e-15);
  EXPECT_EQ(spots.at(2), other) << "near is not the same";
  EXPECT_EQ(spots.part(), 2u) << "the same again from the same state";
}

TEST(Coincidence, AnyNumberFindsPlacesAboutTheSameCentre) {
  const Vec3 spot{1.4, 0.1, -0.6};
  for (const int count : {2, 3, 10, 11}) {
    Spots spots{std::vector<Vec3>(static_cast<std::size_t>(count), spot)};
    EXPECT_EQ(spots.part(), static_cast<std::uint64_t>(count / 2 * 2)) << "of an odd number one stays";
    Vec3 centre = Vec3::Zero();
    for (int a = 1; a <= count; ++a) {
      centre += spots.at(static_cast<std::uint32_t>(a)) / count;
      for (int b = 1; b < a; ++b) {
        const double distance = (spots.at(static_cast<std::uint32_t>(a)) - spots.at(static_cast<std::uint32_t>(b))).norm();
        EXPECT_GT(distance, 0.05 * kShift);
      }
    }
    EXPECT_LT((centre - spot).norm(), 1e-15);
  }
}

TEST(Coincidence, ADrivenParticleStaysWithItsWound) {
  const Vec3 spot{0.1, 0.2, 0.3};
  Spots spots{{spot, spot}};
  spots.drive(2);
  EXPECT_EQ(spots.part(), 1u);
  EXPECT_EQ(spots.at(2), spot);
  EXPECT_NEAR((spots.at(1) - spot).norm(), kShift, 1e-15);
}

TEST(Coincidence, APlanarWorldKeepsItsLayer) {
  const Vec3 spot{0.1, 0.2, 0.3};
  Spots spots{{spot, spot}, true};
  EXPECT_EQ(spots.part(), 2u);
  EXPECT_EQ(spots.at(1).z(), 0.3);
  EXPECT_EQ(spots.at(2).z(), 0.3);
  EXPECT_NEAR((spots.at(1) - spots.at(2)).norm(), 2.0 * kShift, 1e-15);
}

}  // namespace
}  // namespace bleedsim::sph
