// Wounds that would bleed inside tissue, with the limits of what is forgiven. Spacing 1 mm.
#include "service/sph/wound/buried_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>

#include "service/sph/wound/wound_rules.h"
#include "tests/unit/wound/throat_world.h"

namespace bleedsim::sph {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kDx = 0.001;
using Fault = BuriedPatch::Fault;

WorldDescription sceneWith(decltype(TissueDescription::shape) shape) {
  WorldDescription scene = plainDescription(kDx);
  scene.tissue.push_back({.name = "liver", .shape = std::move(shape)});
  return scene;
}
WorldDescription onPlane() { return sceneWith(PlaneShape{}); }
/// A hollow of radius 60 mm, 20 mm deep, its lowest point at z = -20 mm.
WorldDescription inBowl() { return sceneWith(BowlShape{.rim_center = Vec3::Zero(), .sphere_radius = 0.06, .depth = 0.02}); }
/// A container from the origin to 40 mm, centred about x = y = 0.
WorldDescription inContainer() { return sceneWith(BoxShape{.lower = {-0.02, -0.02, 0.0}, .upper = {0.02, 0.02, 0.04}}); }

WoundDescription discAt(const Vec3& position, const Vec3& normal = Vec3::UnitZ(), double radius = 0.003) {
  WoundDescription wound = discWound(radius, 1e-6);
  wound.position = position;
  wound.normal = normal;
  return wound;
}

std::optional<BuriedPatch> buriedIn(const WorldDescription& scene, const WoundDescription& wound) {
  const WoundRules rules{scene, 5.0};
  const Result<Opening> opening = rules.plan(wound);
  EXPECT_TRUE(opening.ok()) << opening.status().message();
  return opening ? rules.buried(*opening) : std::nullopt;
}

void expectRefused(const WorldDescription& scene, const WoundDescription& wound, Fault fault, const std::string& reason) {
  const auto buried = buriedIn(scene, wound);
  ASSERT_TRUE(buried) << reason;
  EXPECT_EQ(static_cast<int>(buried->fault), static_cast<int>(fault)) << buried->reason;
  EXPECT_EQ(buried->reason, reason);
}

Vec3 tilted(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::sin(angle), 0.0, std::cos(angle)};
}

TEST(BuriedPatch, WhatIsOnTheSurfaceOrInFrontOfItIsAccepted) {
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, 0})));
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, 0.02})));
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, 0.02}, -Vec3::UnitZ()))) << "from above, as in the scene drip";
  EXPECT_FALSE(buriedIn(plainDescription(kDx), discAt({0, 0, -0.02}))) << "there is no tissue";
  EXPECT_FALSE(buriedIn(inBowl(), discAt({0, 0, -0.02})));
  EXPECT_FALSE(buriedIn(inBowl(), discAt({0.045, 0, 0}, Vec3::UnitZ(), 0.004))) << "partly over the hollow, on its rim";
  EXPECT_FALSE(buriedIn(inContainer(), discAt({0.017, -0.017, 0}))) << "touches two sides of the corner";
  EXPECT_FALSE(buriedIn(inContainer(), discAt({0.02, 0, 0.02}, -Vec3::UnitX()))) << "in a side";
}

// Set free dx/2 in front of the patch: a patch that faces the blood may be dx/2 deep, and not more.
TEST(BuriedPatch, HalfASpacingIsForgiven) {
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, -0.4999 * kDx})));
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, -0.5 * kDx}))) << "not by rounding";
  EXPECT_TRUE(buriedIn(onPlane(), discAt({0, 0, -0.5001 * kDx})));
}

TEST(BuriedPatch, APositionInsideIsToldWithItsDepthAndThePlaceOnTheSurface) {
  expectRefused(onPlane(), discAt({0.01, 0, -0.004}), Fault::position,
                "(0.01, 0, -0.004) m is 4 mm inside tissue: use (0.01, 0, 0) m, on the surface of 'liver'");
  expectRefused(onPlane(), discAt({0, 0, -0.004}, -Vec3::UnitZ()), Fault::position,
                "(0, 0, -0.004) m is 4 mm inside tissue: use (0, 0, 0) m, on the surface of 'liver'");
  expectRefused(inBowl(), discAt({0, 0, -0.0225}), Fault::position,
                "(0, 0, -0.0225) m is 2.5 mm inside tissue: use (0, 0, -0.02) m, on the surface of 'liver'");
  expectRefused(inContainer(), discAt({0.03, 0, 0.02}, -Vec3::UnitX()), Fault::position,
                "(0.03, 0, 0.02) m is 10 mm inside tissue: use (0.02, 0, 0.02) m, on the surface of 'liver'");
  WorldDescription nameless = onPlane();
  nameless.tissue[0].name.clear();
  expectRefused(nameless, discAt({0, 0, -0.004}), Fault::position,
                "(0, 0, -0.004) m is 4 mm inside tissue: use (0, 0, 0) m, on the surface");
}

TEST(BuriedPatch, ANormalIntoTheTissueIsToldWithTheTissuesOwn) {
  expectRefused(
      onPlane(), discAt({0, 0, 0}, -Vec3::UnitZ()), Fault::normal,
      "(0, 0, -1) lets blood out 0.5 mm inside tissue at (0, 0, 0) m: turn it to the blood's side, (0, 0, 1) of 'liver'");
  const auto bowl = buriedIn(inBowl(), discAt({0, 0, -0.02}, -Vec3::UnitZ()));
  ASSERT_TRUE(bowl);
  EXPECT_EQ(static_cast<int>(bowl->fault), static_cast<int>(Fault::normal));
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, 0}, Vec3::UnitX(), 0.0001))) << "a jet along the surface is none";
}

// A disc of radius r that is tilted by t dips r sin t; its particles come free dx/2 cos t higher. The lattice's outermost sites
// stand at r exactly here.
TEST(BuriedPatch, ATiltedPatchMayDipHalfASpacing) {
  const double limit = std::atan(0.5 * kDx / 0.003) * 180.0 / std::numbers::pi;
  EXPECT_FALSE(buriedIn(onPlane(), discAt({0, 0, 0}, tilted(limit - 0.1))));
  const auto buried = buriedIn(onPlane(), discAt({0, 0, 0}, tilted(limit + 5.0)));
  ASSERT_TRUE(buried);
  EXPECT_EQ(static_cast<int>(buried->fault), static_cast<int>(Fault::extent));
  EXPECT_THAT(buried->reason, AllOf(HasSubstr("reaches 0."), HasSubstr(" mm into tissue at ("),
                                    HasSubstr("turn its normal to (0, 0, 1) of 'liver'")));
}

TEST(BuriedPatch, APartInTheNextTissueIsTold) {
  expectRefused(inContainer(), discAt({0.019, 0, 0}), Fault::extent,
                "reaches 2 mm into tissue at (0.022, 0, 0) m: move it away, make it smaller or turn its normal to (-1, 0, 0) of "
                "'liver'");
}

// At r = 10 mm from its middle a flat patch on the bottom lies r^2/2R = 0.83 mm in the tissue, and so it must.
TEST(BuriedPatch, AFlatPatchFitsIntoAHollow) {
  EXPECT_FALSE(buriedIn(inBowl(), discAt({0, 0, -0.02}, Vec3::UnitZ(), 0.01)));
  EXPECT_TRUE(buriedIn(inBowl(), discAt({0, 0, -0.0206}, Vec3::UnitZ(), 0.01))) << "deeper by 0.6 dx";
}

TEST(BuriedPatch, SitesAcrossAPeriodicSideAreWhereTheyComeOut) {
  WorldDescription scene = sceneWith(BoxShape{.lower = {0.03, -0.01, -0.01}, .upper = {0.06, 0.01, 0.01}, .obstacle = true});
  scene.domain.periodic = {true, false, false};
  EXPECT_FALSE(buriedIn(scene, discAt({-0.045, 0, 0}))) << "ends before the side";
  EXPECT_TRUE(buriedIn(scene, discAt({-0.049, 0, 0}))) << "comes out within the block at x = 48 to 50 mm";
}

TEST(BuriedPatch, ACommandIsRefusedAndChangesNothing) {
  ThroatWorld world{onPlane()};
  ASSERT_TRUE(world.set.add(discAt({0, 0, 0})).ok());
  world.step(1e-3);
  const auto added = world.set.add(discAt({0.02, 0, -0.004}));
  ASSERT_FALSE(added.ok());
  EXPECT_EQ(added.status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(added.status().message(),
            "wound position (0.02, 0, -0.004) m is 4 mm inside tissue: use (0.02, 0, 0) m, on the surface of 'liver'");
  const Status moved = world.set.update(moveChange(1, {0, 0, -0.001}), world.withdrawing());
  EXPECT_EQ(moved.code(), StatusCode::invalid_argument);
  EXPECT_THAT(moved.message(), HasSubstr("wound position (0, 0, -0.001) m is 1 mm inside tissue"));
  UpdateWound turn;
  turn.wound_id = 1;
  turn.normal = -Vec3::UnitZ();
  EXPECT_THAT(world.set.update(turn, world.withdrawing()).message(), HasSubstr("wound normal (0, 0, -1) lets blood out"));
  UpdateWound widen;
  widen.wound_id = 1;
  widen.shape = DiscPatch{0.004};
  EXPECT_TRUE(world.set.update(widen, world.withdrawing()).ok());
  EXPECT_EQ(world.set.description(1)->position, Vec3::Zero());
  EXPECT_EQ(world.withdrawn, world.set.withdrawnParticles()) << "only the accepted change took particles back";
}

}  // namespace
}  // namespace bleedsim::sph
