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

/// The smallest signed distances that were measured, in spacings: of a lone particle and of a block of 4 x 4 x 4.
struct Reached {
  double lone, block;
};

struct Shot {
  std::string name;
  sph::TissueShape shape;
  sph::Vec3 direction;  ///< unit
  sph::Vec3 target;     ///< m
  Reached slow, fast;   ///< at U and 3U
};

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Shot& one, std::ostream* out) { *out << one.name; }

class ShotTest : public testing::TestWithParam<Shot> {};

// A normal shot of one particle at v compresses the spring to 0.5 - v/c0 spacings; c0 = 10 U. Allowed is 1.5 times the
// compression 0.5 - phi that was reached. walls.md: +0.35 at U and +0.04 at 3U, and no projection at all. Reached is the smallest
// of h = 2 and 2.5 dx, without and with viscosity, in float32 and in double, whose targets differ by less than 0.002 for lone
// particles and 0.01 for blocks.
TEST_P(ShotTest, staysInFront) {
  for (const double speed : {1.0, 3.0}) {
    for (const int across : {1, 4}) {
      for (const double viscosity : {0.0, 0.00345}) {
        for (const double support_ratio : {2.0, 2.5}) {
          SCOPED_TRACE(testing::Message() << speed << " U, " << across << " across, mu " << viscosity << ", h/dx "
                                          << support_ratio);
          sph::WorldDescription scene = emptyScene();
          scene.support_ratio = support_ratio;
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
          const Reached& reached = speed > 1.0 ? GetParam().fast : GetParam().slow;
          EXPECT_GT(lowest, 0.5 - 1.5 * (0.5 - (across > 1 ? reached.block : reached.lone)));
          EXPECT_LT(lowest, 0.5) << "the shot must have arrived";
          EXPECT_GT(closest_time, 0.99 * (start - 0.5) * kSpacing / (speed * design)) << "nothing is faster than its flight";
          EXPECT_EQ(counterOf(*world, sph::Counter::tissue_projected), 0u);
          expectInvariants(*world);
        }
      }
    }
  }
}

std::vector<Shot> shots() {
  sph::BoxShape box;
  box.lower = {0, -0.045, 0};  // the edge at x = z = 0; what splashes along it at 5 U does not reach the ends
  box.upper = {0.03, 0.045, 0.03};
  sph::BoxShape corner;
  corner.upper = sph::Vec3::Constant(0.03);
  sph::BowlShape bowl;
  bowl.rim_center = {0, 0, 0.006};
  bowl.sphere_radius = 0.006;
  bowl.depth = 0.006;
  const double half = std::sqrt(0.5);
  const double third = std::sqrt(1.0 / 3.0);
  return {{"plane", sph::PlaneShape{}, {0, 0, -1}, {0.0002, 0.0001, 0}, {0.401, 0.399}, {0.202, 0.202}},
          {"planeAskew", sph::PlaneShape{}, {half, 0, -half}, {0, 0, 0}, {0.429, 0.424}, {0.288, 0.289}},
          {"edge", box, {-half, 0, -half}, {0, 0, 0}, {0.430, 0.270}, {0.287, 0.271}},
          {"corner", corner, {-third, -third, -third}, {0, 0, 0}, {0.442, 0.314}, {0.328, 0.204}},
          {"bowl", bowl, {0, 0, -1}, {0.0003, 0, 0}, {0.399, 0.366}, {0.201, 0.130}}};
}

INSTANTIATE_TEST_SUITE_P(shapes, ShotTest, testing::ValuesIn(shots()), [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::test
