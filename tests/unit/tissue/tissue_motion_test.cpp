// A lone particle thrown at tissue. Its density stays below rest, so that the contact spring alone stops it: with the potential
// c0^2 ((dx/2 - d)/dx)^2 / 2 a head-on shot at v turns at d = dx/2 - v dx/c0 and leaves as fast as it came.
#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

constexpr double kSoundSpeed = 3.0;  // m/s

struct Shot {
  std::string name;
  TissueDescription tissue;
  Vec3 target;     ///< on the surface
  Vec3 direction;  ///< of flight
  bool head_on;    ///< along the normal the whole way
};

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Shot& one, std::ostream* out) { *out << one.name; }

struct Flight {
  double lowest = std::numeric_limits<double>::infinity();  ///< phi, spacings
  Vec3 velocity = Vec3::Zero();                             ///< at the end
};

Flight fly(const Shot& shot, double speed) {
  const auto field = fieldOf<double>({shot.tissue}, 2.0);
  const double dt = 0.1 * kSpacing / kSoundSpeed;
  Vec3 position = shot.target - 3.0 * kSpacing * shot.direction.normalized();
  Flight flight{.velocity = speed * shot.direction.normalized()};
  const auto pushed = [&] {
    WallSample<double> wall;
    if (!field.sample(position.x(), position.y(), position.z(), wall)) return Vec3{Vec3::Zero()};
    return Vec3{kSoundSpeed * kSoundSpeed * Vec3(wall.spring[0], wall.spring[1], wall.spring[2])};
  };
  const int steps = static_cast<int>(6.0 * kSpacing / (speed * dt));
  for (int step = 0; step < steps; ++step) {
    flight.velocity += 0.5 * dt * pushed();
    position += dt * flight.velocity;
    flight.velocity += 0.5 * dt * pushed();
    flight.lowest = std::min(flight.lowest, field.distance(position.x(), position.y(), position.z()) / kSpacing);
  }
  return flight;
}

class TissueMotionTest : public testing::TestWithParam<Shot> {};

TEST_P(TissueMotionTest, bouncesWithoutPenetratingOrGainingEnergy) {
  for (const double mach : {0.1, 0.3}) {
    const double speed = mach * kSoundSpeed;
    const Flight flight = fly(GetParam(), speed);
    EXPECT_GT(flight.lowest, 0.5 - 1.02 * mach) << mach;
    EXPECT_LT(flight.lowest, 0.5) << "it arrives";
    EXPECT_NEAR(flight.velocity.norm() / speed, 1.0, 0.02) << mach;
    if (!GetParam().head_on) continue;
    EXPECT_NEAR(flight.lowest, 0.5 - mach, 0.02) << mach;
    EXPECT_LT((flight.velocity / speed + GetParam().direction.normalized()).norm(), 0.02) << mach;
  }
}

std::vector<Shot> shots() {
  const double dx = kSpacing;
  const BoxShape box{.lower = Vec3::Constant(-8 * dx), .upper = Vec3::Constant(8 * dx)};
  BoxShape block = box;
  block.obstacle = true;
  const BowlShape bowl{.sphere_radius = 6 * dx, .depth = 4 * dx};
  const double rim = std::sqrt(32.0) * dx;
  return {{"plane", tissueOf(PlaneShape{}), Vec3::Zero(), {0, 0, -1}, true},
          {"planeSlanted", tissueOf(PlaneShape{}), Vec3::Zero(), {1, 0, -1}, false},
          {"containerEdge", tissueOf(box), {-8 * dx, 0, -8 * dx}, {-1, 0, -1}, false},
          {"containerCorner", tissueOf(box), box.lower, {-1, -1, -1}, false},
          {"blockFace", tissueOf(block), {0, 0, 8 * dx}, {0, 0, -1}, true},
          {"blockEdge", tissueOf(block), {8 * dx, 0, 8 * dx}, {-1, 0, -1}, true},
          {"blockCorner", tissueOf(block), block.upper, {-1, -1, -1}, true},
          {"bowlBottom", tissueOf(bowl), {0, 0, -4 * dx}, {0, 0, -1}, true},
          {"bowlSide", tissueOf(bowl), {4 * dx, 0, 2 * dx - std::sqrt(20.0) * dx}, {1, 0, -0.2}, false},
          {"bowlRim", tissueOf(bowl), {rim, 0, 0}, {1, 0, -1}, true}};
}

INSTANTIATE_TEST_SUITE_P(shots, TissueMotionTest, testing::ValuesIn(shots()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::sph
