// Flow curves against their closed forms by the C library, and the viscosity that a world gives its particles.
#include "service/sph/effects/rheology.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/unit/sph/thinning.h"

namespace bleedsim::sph {
namespace {

template <class Real>
class FlowCurve : public testing::Test {
 public:
  static constexpr double kTolerance = sizeof(Real) == 4 ? 1e-6 : 1e-12;  // a few roundings, relative
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FlowCurve, Scalars);

TYPED_TEST(FlowCurve, CarreauYasuda) {
  for (const double transition : {2.0, 0.64}) {
    CarreauYasudaRheology law;
    law.transition = transition;
    for (const double g : {0.0, 1e-3, 0.1, 0.3, 1.0, 10.0, 400.0, 1e5}) {
      const double exact =
          0.00345 + (0.056 - 0.00345) * std::pow(1.0 + std::pow(3.313 * g, transition), (0.3568 - 1.0) / transition);
      EXPECT_NEAR(double(viscosityAt(law, static_cast<TypeParam>(g))) / exact, 1.0, TestFixture::kTolerance) << g;
    }
  }
}

TYPED_TEST(FlowCurve, Casson) {
  const CassonRheology law;
  for (const double g : {1e-4, 9e-4, 1.1e-3, 0.1, 0.3, 1.0, 10.0, 400.0, 1e5}) {
    const double root = std::sqrt(0.0035) + std::sqrt(-0.005 * std::expm1(-g / 0.1) / g);
    // Just above the series 1 - exp(-x) has lost two of the seven digits of a float.
    EXPECT_NEAR(double(viscosityAt(law, static_cast<TypeParam>(g))) / (root * root), 1.0, 10 * TestFixture::kTolerance) << g;
  }
  const double rest = std::sqrt(0.0035) + std::sqrt(0.005 / 0.1);
  EXPECT_NEAR(viscosityAt(law, TypeParam(0)), rest * rest, TestFixture::kTolerance) << "at rest: the regularised limit";
}

// (26) with a = ln(b/mu_fresh)/0.99.
TYPED_TEST(FlowCurve, Platelets) {
  const double fresh = 0.0041;
  const double clot = 10.0;
  const double a = std::log(clot / fresh) / 0.99;
  for (const double p : {0.0, 0.2, 0.5, 0.99, 1.0}) {
    const auto found =
        static_cast<double>(thickened(static_cast<TypeParam>(fresh), static_cast<TypeParam>(clot), static_cast<TypeParam>(p)));
    EXPECT_NEAR(found / (clot * std::exp(-a * p)), 1.0, TestFixture::kTolerance) << p;
  }
  EXPECT_NEAR(double(thickened(TypeParam(0.0041), TypeParam(10), TypeParam(0.99))), 0.0041, 1e-8) << "fresh blood is as it flows";
}

double viscosityOfFirst(const WorldDescription& description) {
  return double(test::frameOf(*test::makeWorld(description)).viscosity.at(0));
}

// A block at rest: mu(g = 0) of its law, b exp(-a P) of that, or of the block's own.
TEST(EffectiveViscosityOf, BloodAtRest) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  description.effects.viscosity->viscosity = 0.004;
  description.effects.viscosity->rheology = CarreauYasudaRheology{};
  EXPECT_NEAR(viscosityOfFirst(description), 0.056, 1e-8);
  description.fluid_blocks[0].viscosity = 0.02;
  EXPECT_NEAR(viscosityOfFirst(description), 0.02, 1e-8) << "a block's own is Newtonian";
  description.effects.platelets.emplace();
  EXPECT_NEAR(viscosityOfFirst(description), 0.02, 1e-8) << "fresh";
  description.fluid_blocks[0].platelet = 0.0;
  EXPECT_NEAR(viscosityOfFirst(description), 10.0, 1e-5) << "clotted";
  description.fluid_blocks[0].platelet = 0.495;
  EXPECT_NEAR(viscosityOfFirst(description), std::sqrt(10.0 * 0.02), 1e-6) << "half way on the logarithm";
  description.fluid_blocks[0].viscosity.reset();
  EXPECT_NEAR(viscosityOfFirst(description), std::sqrt(10.0 * 0.056), 1e-6);
  description.effects.viscosity->rheology = NewtonianRheology{};
  EXPECT_NEAR(viscosityOfFirst(description), std::sqrt(10.0 * 0.004), 1e-6);
}

// A block's own viscosity is still its own after many steps, sorts and neighbours.
TEST(EffectiveViscosityOf, BlocksKeepTheirOwn) {
  WorldDescription description = test::freeBlock({6, 5, 5}, 0.1);
  FluidBlock thick = description.fluid_blocks[0];
  thick.lower.x() += 0.006;
  thick.upper.x() += 0.006;
  thick.viscosity = 0.02;
  thick.velocity = {-0.1, 0.1, 0.0};
  description.fluid_blocks.push_back(thick);
  description.capacity = 400;
  description.effects.viscosity->rheology = CassonRheology{};
  const auto world = test::makeWorld(description);
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(world->step(1.0).ok());
  const FrameBuffer frame = test::frameOf(*world);
  int own = 0;
  int sheared = 0;
  for (std::size_t i = 0; i < frame.count; ++i) {
    if (frame.id[i] > 150) {
      EXPECT_NEAR(frame.viscosity[i], 0.02, 1e-8);
      ++own;
    } else {
      EXPECT_GT(frame.viscosity[i], 0.0035f);
      sheared += frame.viscosity[i] < 0.02f ? 1 : 0;
    }
  }
  EXPECT_EQ(own, 150);
  EXPECT_GT(sheared, 10);
}

// dt <= 0.045 h^2 rho/mu of the thickest particle of the moment.
TEST(EffectiveViscosityOf, TheTimeStepFollowsTheThickestParticle) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  description.effects.viscosity->solve = ViscositySolve::explicit_;
  description.effects.platelets.emplace();
  description.fluid_blocks[0].platelet = 0.0;
  const auto world = test::makeWorld(description);
  ASSERT_TRUE(world->step(1.0).ok());
  const double h = description.supportRadius();
  EXPECT_NEAR(test::statsOf(*world).dt, 0.045 * h * h * test::kRestDensity / 10.0, 1e-6 * 1.9e-5);
  description.fluid_blocks[0].platelet.reset();
  const auto fresh = test::makeWorld(description);
  ASSERT_TRUE(fresh->step(1.0).ok());
  EXPECT_GT(test::statsOf(*fresh).dt, 4.0 * test::statsOf(*world).dt) << "the acoustic limit";
}

TEST(RheologyOfAScene, IsRefusedWithWhatWouldDo) {
  WorldDescription description = test::freeBlock({4, 4, 4});
  const auto refused = [&](const char* word) {
    const auto world = createWorld(description, {});
    ASSERT_FALSE(world.ok()) << word;
    EXPECT_EQ(world.status().code(), StatusCode::invalid_argument);
    EXPECT_NE(world.status().message().find(word), std::string::npos) << world.status().message();
  };
  description.effects.viscosity->rheology = CarreauYasudaRheology{.zero_shear = 0.0};
  refused("viscosity at rest");
  description.effects.viscosity->rheology = CarreauYasudaRheology{.power = 1.5};
  refused("power");
  description.effects.viscosity->rheology = CarreauYasudaRheology{.transition = std::nan("")};
  refused("transition");
  description.effects.viscosity->rheology = CassonRheology{.yield_stress = -1.0};
  refused("yield stress");
  description.effects.viscosity->rheology = CassonRheology{.regularisation_shear_rate = 0.0};
  refused("regularisation");
  description.effects.viscosity->rheology = NewtonianRheology{};
  description.effects.platelets.emplace();
  description.fluid_blocks[0].viscosity = 0.0;
  refused("greater than 0");
  description.fluid_blocks[0].viscosity.reset();
  description.effects.viscosity->viscosity = 0.0;
  refused("greater than 0");
}

}  // namespace
}  // namespace bleedsim::sph
