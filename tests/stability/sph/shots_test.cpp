// Blood thrown at tissue never goes through it: walls.md, "shots at U and 3U at plane, edge, corner, bowl". U is the design
// speed.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "service/sph/tissue/signed_distance.h"
#include "tests/stability/sph/measure.h"

namespace bleedsim::test {
namespace {

struct Shot {
  std::string name;
  sph::TissueShape shape;
  sph::Vec3 direction;  ///< unit
  sph::Vec3 target;     ///< m
};

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Shot& one, std::ostream* out) { *out << one.name; }

class ShotTest : public testing::TestWithParam<Shot> {};

// Bound: 0.1 dx, physics.md section 6. A normal shot of one particle at v compresses the spring to 0.5 - v/c0 spacings; c0 = 10
// U.
TEST_P(ShotTest, staysInFront) {
  for (const double speed : {1.0, 3.0}) {
    for (const int across : {1, 4}) {
      for (const double viscosity : {0.0, 0.00345}) {
        sph::WorldDescription scene = emptyScene();
        scene.tissue.push_back({.name = GetParam().name, .shape = GetParam().shape});
        scene.effects.pressure.emplace();
        if (viscosity > 0.0) scene.effects.viscosity.emplace();
        const double design = scene.compressibility.design_speed;
        const double side = across * kSpacing;
        addBlock(scene, GetParam().target - 0.006 * GetParam().direction - sph::Vec3::Constant(0.5 * side),
                 {across, across, across}, speed * design * GetParam().direction);
        const auto world = makeWorld(scene);
        const double start = lowestPhi(*world);
        double lowest = start;
        double closest_time = 0.0;
        runFor(*world, 0.02 / (speed * design), [&] {
          const double now = lowestPhi(*world);
          if (now < lowest) closest_time = world->time();
          lowest = std::min(lowest, now);
        });
        EXPECT_GT(lowest, -0.1) << speed << " U, " << across << " across, mu " << viscosity;
        EXPECT_LT(lowest, 0.5) << "the shot must have arrived";
        EXPECT_GT(closest_time, 0.99 * (start - 0.5) * kSpacing / (speed * design)) << "nothing is faster than its flight";
        EXPECT_LE(counterOf(*world, sph::Counter::tissue_projected), speed > 1.0 && across > 1 ? 4u : 0u) << speed << " U";
        expectInvariants(*world);
      }
    }
  }
}

std::vector<Shot> shots() {
  sph::BoxShape box;
  box.lower = sph::Vec3::Zero();
  box.upper = sph::Vec3::Constant(0.03);
  sph::BowlShape bowl;
  bowl.rim_center = {0, 0, 0.006};
  bowl.sphere_radius = 0.006;
  bowl.depth = 0.006;
  const double half = std::sqrt(0.5);
  const double third = std::sqrt(1.0 / 3.0);
  return {{"plane", sph::PlaneShape{}, {0, 0, -1}, {0.0002, 0.0001, 0}},
          {"planeAskew", sph::PlaneShape{}, {half, 0, -half}, {0, 0, 0}},
          {"edge", box, {-half, 0, -half}, {0, 0.015, 0}},
          {"corner", box, {-third, -third, -third}, {0, 0, 0}},
          {"bowl", bowl, {0, 0, -1}, {0.0003, 0, 0}}};
}

INSTANTIATE_TEST_SUITE_P(shapes, ShotTest, testing::ValuesIn(shots()), [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::test
