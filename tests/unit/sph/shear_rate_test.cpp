// The shear rate g = sqrt(2 D:D), effects/shear_rate.h.
#include "service/sph/effects/shear_rate.h"

#include <gtest/gtest.h>

#include "service/sph/seeding.h"
#include "tests/unit/sph/thinning.h"

namespace bleedsim::sph {
namespace {

struct Flow {
  const char* name;
  Vec3 rows[3];       // grad v, 1/s
  double shear_rate;  // 1/s
};

constexpr double kTolerance = 5e-4;  // 1e-5 of 50/s

class LinearFlow : public testing::TestWithParam<Flow> {
 public:
  static Vec3 at(const Flow& flow, const Vec3& x) { return {flow.rows[0].dot(x), flow.rows[1].dot(x), flow.rows[2].dot(x)}; }
};

// A B^-1 is exact for a linear velocity on any particles, those at the free surface included; floats leave 1e-5 of the gradient.
TEST_P(LinearFlow, HasItsExactShearRateOnEveryTargetAndSide) {
  const Flow& flow = GetParam();
  for (const bool jitter : {false, true}) {
    WorldDescription description = withFlow(test::freeBlock({7, 7, 7}), [&](const Vec3& x) { return at(flow, x); });
    if (jitter) {  // the velocity must be that of where the particle stands
      JitterSource random{3};
      for (FluidBlock& block : description.fluid_blocks) {
        const double x = random.next();
        const double y = random.next();
        const Vec3 shift = 0.2 * test::kSpacing * Vec3{x, y, random.next()};
        block.lower += shift;
        block.upper += shift;
        block.velocity = at(flow, 0.5 * (block.lower + block.upper));
      }
    }
    for (const SimdTarget target : availableSimdTargets()) {
      const auto world = test::makeWorld(description, {.simd = target});
      forEachShearRate(*world,
                       [&](const Vec3&, double g) { EXPECT_NEAR(g, flow.shear_rate, kTolerance) << simdTargetName(target); });
    }
    const auto reference = test::makeWorld(description, {.precision = Precision::float64});
    forEachShearRate(*reference, [&](const Vec3&, double g) { EXPECT_NEAR(g, flow.shear_rate, kTolerance); });
  }
}

INSTANTIATE_TEST_SUITE_P(Flows, LinearFlow,
                         testing::Values(Flow{"Shear", {{0, 0, 50}, {0, 0, 0}, {0, 0, 0}}, 50.0},
                                         Flow{"ShearAcross", {{0, 30, 0}, {0, 0, 40}, {0, 0, 0}}, 50.0},
                                         Flow{"Stretch", {{20, 0, 0}, {0, -20, 0}, {0, 0, 0}}, 40.0},
                                         Flow{"Rotation", {{0, -50, 0}, {50, 0, 0}, {0, 0, 0}}, 0.0},
                                         Flow{"Rest", {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 0.0}),
                         [](const auto& flow) { return flow.param.name; });

WorldDescription onFloor(double slip) {
  WorldDescription description = test::freeBlock({7, 7, 7});
  FluidBlock& block = description.fluid_blocks[0];
  const double up = block.upper.z();
  block.lower.z() += up;
  block.upper.z() += up;
  description.tissue.push_back({.name = "floor", .shape = PlaneShape{}, .slip = slip});
  return description;
}

// The wall's layers move as -v depth/d, so a shear flow over the wall keeps its gradient there; float shares leave no error.
TEST(ShearRateAtTissue, OfAShearFlowIsExact) {
  const auto world = test::makeWorld(withFlow(onFloor(0.0), [](const Vec3& x) { return Vec3{50.0 * x.z(), 0, 0}; }));
  int seen = 0;
  forEachShearRate(*world, [&](const Vec3&, double g) {
    EXPECT_NEAR(g, 50.0, kTolerance);
    ++seen;
  });
  EXPECT_EQ(seen, 343);
}

// Blood that slides as one is sheared at a wall that holds it, not at one that lets it slip, and not far from either.
TEST(ShearRateAtTissue, NeedsAGrip) {
  const auto sliding = [](const Vec3&) { return Vec3{0.1, 0, 0}; };
  const auto held = test::makeWorld(withFlow(onFloor(0.0), sliding));
  forEachShearRate(*held, [](const Vec3& x, double g) {
    if (x.z() < 0.001) {
      EXPECT_GT(g, 30.0);
    } else if (x.z() > 0.002) {
      EXPECT_LT(g, kTolerance);
    }
  });
  const auto slipping = test::makeWorld(withFlow(onFloor(1.0), sliding));
  forEachShearRate(*slipping, [](const Vec3&, double g) { EXPECT_LT(g, kTolerance); });
}

// Plane Poiseuille u = 4 U z (H - z)/H^2 over 12 rows: |du/dz| at the rows' middles, relative to the wall's 4 U/H. With the
// walls' layers the first row has WALL %; without, one-sided, ONE %.
TEST(ShearRateAtTissue, OfAPoiseuilleProfileIsNearlyExact) {
  constexpr double kHeight = 12 * test::kSpacing;
  constexpr double kSpeed = 0.1;
  WorldDescription description = test::freeBlock({9, 9, 12});
  FluidBlock& block = description.fluid_blocks[0];
  block.lower.z() = 0.0;
  block.upper.z() = kHeight;
  const auto worst = [&](const WorldDescription& d) {
    const auto world = test::makeWorld(withFlow(d, [](const Vec3& x) {
      return Vec3{4.0 * kSpeed * x.z() * (kHeight - x.z()) / (kHeight * kHeight), 0, 0};
    }));
    double largest = 0.0;
    forEachShearRate(*world, [&](const Vec3& x, double g) {
      if (std::max(std::abs(x.x()), std::abs(x.y())) > 0.0021) return;  // the block's sides
      const double exact = 4.0 * kSpeed / kHeight * std::abs(1.0 - 2.0 * x.z() / kHeight);
      largest = std::max(largest, std::abs(g - exact) * kHeight / (4.0 * kSpeed));
    });
    return largest;
  };
  const double one_sided = worst(description);
  description.tissue.push_back({.name = "floor", .shape = PlaneShape{}});
  description.tissue.push_back({.name = "lid", .shape = PlaneShape{.point = {0, 0, kHeight}, .normal = {0, 0, -1}}});
  const double with_walls = worst(description);
  RecordProperty("one_sided", std::to_string(one_sided));
  RecordProperty("with_walls", std::to_string(with_walls));
  EXPECT_LT(with_walls, 0.05);
  EXPECT_LT(with_walls, one_sided);
}

WorldDescription loose(const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities) {
  WorldDescription description = test::freeBlock({1, 1, 1});
  description.effects.viscosity->rheology = steepLaw();
  const FluidBlock one = description.fluid_blocks[0];
  description.fluid_blocks.clear();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    FluidBlock block = one;
    block.lower += positions[i];
    block.upper += positions[i];
    block.velocity = velocities[i];
    description.fluid_blocks.push_back(block);
  }
  return description;
}

// B is singular: a direction without neighbours gives no gradient, and what there is stays below |dv|/r.
TEST(ShearRateOfFew, IsFiniteAndBounded) {
  const double dx = test::kSpacing;
  const auto of = [](const WorldDescription& description) {
    std::vector<double> rates;
    forEachShearRate(*test::makeWorld(description), [&](const Vec3&, double g) { rates.push_back(g); });
    return rates;
  };
  EXPECT_LT(of(loose({Vec3::Zero()}, {{0.1, 0.2, 0.3}})).at(0), kTolerance) << "an isolated particle";

  for (const double apart : {0.5, 1.0, 1.9}) {  // a pair that shears: D has dv/2r beside the diagonal, so g = dv/r
    for (const double g : of(loose({Vec3::Zero(), {apart * dx, 0, 0}}, {Vec3::Zero(), {0, 0.1, 0}}))) {
      EXPECT_GE(g, 0.0);
      EXPECT_LE(g, 0.1 / (apart * dx));
    }
  }
  for (const double g : of(loose({Vec3::Zero(), Vec3::Zero()}, {Vec3::Zero(), {0, 0.1, 0}})))
    EXPECT_LT(g, kTolerance) << "coincident";

  WorldDescription film = test::freeBlock({7, 7, 1});
  forEachShearRate(*test::makeWorld(withFlow(film,
                                             [](const Vec3& x) {
                                               return Vec3{50.0 * x.y(), 0, 0};
                                             })),
                   [](const Vec3& x, double g) {
                     EXPECT_LE(g, 50.0);  // the lifted B holds back a tenth of t
                     if (std::max(std::abs(x.x()), std::abs(x.y())) < 0.0015) { EXPECT_GT(g, 40.0); }
                   });
}

TEST(ShearRateNeeded, OnlyByThinningBloodAndTheGateOfPlatelets) {
  EffectSettings effects;
  EXPECT_FALSE(shearRateNeeded(effects));
  effects.viscosity.emplace();
  EXPECT_FALSE(shearRateNeeded(effects));
  effects.viscosity->rheology = CassonRheology{};
  EXPECT_TRUE(shearRateNeeded(effects));
  effects.viscosity.reset();
  effects.platelets.emplace();
  EXPECT_TRUE(shearRateNeeded(effects));
  effects.platelets->activation_rate = 0.0;
  EXPECT_FALSE(shearRateNeeded(effects));
}

// Its arrays are the only ones that effects own here: without the effect there are none.
TEST(ShearRateNeeded, OtherwiseNothingIsReserved) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  EXPECT_EQ(test::makeWorld(description)->memory().effects, 0u);
  const std::size_t plain = test::makeWorld(description)->memory().particles;
  description.effects.viscosity->rheology = CarreauYasudaRheology{};
  EXPECT_GE(test::makeWorld(description)->memory().effects, description.capacity * (kShearMoments + 1) * sizeof(float));
  EXPECT_GT(test::makeWorld(description)->memory().particles, plain) << "a viscosity of each particle's own";
}

}  // namespace
}  // namespace bleedsim::sph
