// Particles on one spot are set apart: neighbors/coincidence.h.
#include "service/sph/neighbors/coincidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

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
  explicit Spots(const std::vector<Vec3>& places, bool planar = false, const std::array<bool, 3>& periodic = {})
      : count_{static_cast<std::uint32_t>(places.size())},
        placed_{count_, {}, 0},
        particles_{count_, {}, Particles<double>::kArrays},
        grid_{count_, {-4, -4, -4}, {4, 4, 4}, periodic, 0.0, 1},
        coincidence_{kSpacingPerRadius, planar, {{-4, -4, -4}, {4, 4, 4}, periodic}, 1},
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

  void useOneCell() {
    grid_.useOneCell();
    coincidence_.useOneCell(count_);
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

// Every corner, edge and side of the domain has pairs that would go out.
TEST(Coincidence, NoneLeavesTheDomain) {
  for (const bool periodic : {false, true}) {
    std::vector<Vec3> places;
    for (const double x : {-4.0, 0.0, 4.0}) {
      for (const double y : {-4.0, 0.0, 4.0}) {
        for (const double z : {-4.0, 0.0, 4.0}) {
          if (periodic && std::max({x, y, z}) == 4.0) continue;  // the same place as at -4
          places.insert(places.end(), 2, Vec3{x, y, z});
        }
      }
    }
    Spots spots{places, false, {periodic, periodic, periodic}};
    EXPECT_EQ(spots.part(), places.size());
    int stopped = 0;
    int across = 0;
    for (std::uint32_t id = 1; id <= places.size(); id += 2) {
      const Vec3 place = places[id - 1];
      for (const std::uint32_t one : {id, id + 1}) {
        const Vec3 at = spots.at(one);
        Vec3 way = at - place;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          EXPECT_TRUE(at[axis] >= -4.0 && (periodic ? at[axis] < 4.0 : at[axis] <= 4.0)) << at.transpose();
          if (std::abs(way[axis]) > 4.0) {
            ++across;
            way[axis] -= std::copysign(8.0, way[axis]);
          } else if (way[axis] == 0.0) {
            ++stopped;
          }
        }
        const Vec3 wanted = kShift * (one == id ? directionOf(id, id + 1) : directionOf(id + 1, id));
        for (Eigen::Index axis = 0; axis < 3; ++axis) EXPECT_NEAR(way[axis], way[axis] == 0.0 ? 0.0 : wanted[axis], 1e-14);
      }
      EXPECT_GT((spots.at(id) - spots.at(id + 1)).norm(), 0.5 * kShift);
    }
    // One of each two at each side that they stand on.
    EXPECT_EQ(stopped, periodic ? 0 : 54);
    EXPECT_EQ(across, periodic ? 12 : 0);
  }
}

TEST(Coincidence, AtASideNoneStaysOnTheSpotOfADrivenParticle) {
  for (const double x : {-4.0, 4.0}) {
    for (const double y : {-4.0, 4.0}) {
      for (const double z : {-4.0, 4.0}) {
        const Vec3 corner{x, y, z};
        Spots spots{{corner, corner}};
        spots.drive(1);
        EXPECT_EQ(spots.part(), 1u);
        EXPECT_NEAR((spots.at(2) - corner).norm(), kShift, 1e-14);
        EXPECT_LE(spots.at(2).cwiseAbs().maxCoeff(), 4.0);
      }
    }
  }
}

// A throat may reach out of the domain; what it releases there is the next drift's to remove.
TEST(Coincidence, WhatStandsOutsideStaysWhereItIs) {
  const Vec3 spot{0.0, 0.0, 4.2};
  Spots spots{{spot, spot}};
  EXPECT_EQ(spots.part(), 2u);
  for (const std::uint32_t id : {1u, 2u}) EXPECT_LT((spots.at(id) - spot).norm(), 1.01 * kShift);
}

/// Place k of a cubic lattice with n places along x and y.
Vec3 latticePlace(int k, int n) {
  const int row = k / n;
  const int layer = row / n;
  return {static_cast<double>(k % n), static_cast<double>(row % n), static_cast<double>(layer)};
}

/// A lattice of n^3 places: every third holds two particles, every twelfth three.
std::vector<Vec3> crowd(int n) {
  std::vector<Vec3> places;
  for (int k = 0; k < n * n * n; ++k) {
    const Vec3 place = 0.5 * latticePlace(k, n) - Vec3::Constant(3.0);
    places.insert(places.end(), k % 12 == 0 ? 3 : k % 3 == 0 ? 2 : 1, place);
  }
  return places;
}

TEST(Coincidence, OneCellPartsTheSame) {
  const std::vector<Vec3> places = crowd(12);
  Spots cells{places};
  Spots one{places};
  one.useOneCell();
  const std::uint64_t parted = cells.part();
  EXPECT_EQ(parted, 2u * 576u) << "of three one stays";
  EXPECT_EQ(one.part(), parted);
  for (std::uint32_t id = 1; id <= places.size(); id += 7) EXPECT_EQ(one.at(id), cells.at(id)) << id;
}

TEST(Coincidence, OneCellLeavesDrivenParticlesAlone) {
  const Vec3 spot{0.1, 0.2, 0.3};
  Spots spots{{spot, spot, spot, spot}};
  spots.useOneCell();
  spots.drive(1);
  spots.drive(3);
  EXPECT_EQ(spots.part(), 2u);
  EXPECT_EQ(spots.at(1), spot);
  EXPECT_EQ(spots.at(3), spot);
  for (const std::uint32_t id : {2u, 4u}) EXPECT_NEAR((spots.at(id) - spot).norm(), kShift, 1e-15);
}

// Pairs are 2 * 10^11: they would take minutes. Half of the places are a heap on one spot, the other half fills a lattice.
TEST(Coincidence, OneCellOfManyIsSorted) {
  std::vector<Vec3> places(300'000, Vec3::Constant(3.5));
  for (int k = 0; k < 300'000; ++k) places.push_back(0.1 * latticePlace(k, 67) - Vec3::Constant(3.3));
  Spots spots{places};
  spots.useOneCell();
  EXPECT_EQ(spots.part(), 300'000u);
}

}  // namespace
}  // namespace bleedsim::sph
