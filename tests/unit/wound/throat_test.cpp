#include "service/sph/wound/throat.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "tests/unit/wound/throat_world.h"

namespace bleedsim::sph {
namespace {

constexpr double kDx = 0.001;
constexpr double kVolume = kDx * kDx * kDx;

TEST(InletTag, PacksEveryFieldAndIsNeverZero) {
  for (const std::uint32_t slot : {1u, 2u, 512u, 1023u}) {
    for (const std::uint32_t site : {0u, 1u, 40000u, 65535u}) {
      for (const std::uint32_t serial : {0u, 1u, 63u}) {
        const InletTag tag{.slot = slot, .site = site, .serial = serial};
        EXPECT_NE(packInletTag(tag), 0u);
        EXPECT_EQ(unpackInletTag(packInletTag(tag)), tag);
      }
    }
  }
}

TEST(Throat, OpensWithAFullColumnBehindThePatchOnly) {
  ThroatWorld world{plainDescription()};
  ASSERT_TRUE(world.set.add(discWound(0.004, 0.0)).ok());
  world.step(0.0);
  const Throat* throat = world.set.throat(1);
  ASSERT_NE(throat, nullptr);
  double deepest = 0.0;
  for (const auto& [tag, state] : world.tagged) {
    EXPECT_LT(state.position.z(), 0.0);
    EXPECT_EQ(state.phase, InletPhase::throat);
    deepest = std::min(deepest, state.position.z());
  }
  EXPECT_GE(deepest, -throat->depth());
  EXPECT_LE(deepest, -2.0 * kDx);  // the support radius
  EXPECT_EQ(world.tagged.size(), throat->unseen());
  const double filled = static_cast<double>(world.tagged.size()) * kVolume;
  EXPECT_NEAR(filled / (throat->area() * throat->depth()), 1.0, 0.02);
  EXPECT_EQ(world.set.emittedParticles(), 0u);
}

TEST(Throat, NoFlowStandsStill) {
  ThroatWorld world{plainDescription()};
  ASSERT_TRUE(world.set.add(discWound(0.004, 0.0)).ok());
  world.step(0.0);
  const auto before = world.tagged;
  for (int i = 0; i < 100; ++i) world.step(0.001);
  ASSERT_EQ(world.tagged.size(), before.size());
  for (const auto& [tag, state] : before) {
    EXPECT_EQ(world.tagged.at(tag).position, state.position);
    EXPECT_EQ(world.tagged.at(tag).velocity, Vec3::Zero());
  }
}

struct EmissionCase {
  const char* name;
  PatchShape shape;
  double top_flow;
};

class ThroatEmission : public testing::TestWithParam<EmissionCase> {};

/// Constant, switched and swinging flow in turn.
double flowAt(int step, double top) {
  if (step < 500) return 0.7 * top;
  if (step < 1500) return step / 37 % 2 == 0 ? top : 0.0;
  return top * (0.5 + 0.5 * std::sin(0.01 * step));
}

TEST_P(ThroatEmission, VolumeIsTheIntegralOfFlowAndNothingOverlaps) {
  const EmissionCase& param = GetParam();
  ThroatWorld world{plainDescription()};
  WoundDescription wound = discWound(0.001, 0.0);
  wound.shape = param.shape;
  wound.normal = Vec3{1, 2, 2};
  ASSERT_TRUE(world.set.add(wound).ok());
  double commanded = 0.0;
  for (int step = 0; step < 3000; ++step) {
    const double dt = 1e-4 * (1.0 + 0.5 * std::sin(step));
    const double flow = flowAt(step, param.top_flow);
    const Status changed = world.set.update(driveChange(1, FlowDrive{flow}), world.withdrawing());
    ASSERT_TRUE(changed.ok()) << changed.message();
    world.step(dt);
    commanded += flow * dt;
    ASSERT_NEAR(world.set.emittedVolume(), commanded, kVolume * (1.0 + 1e-6)) << "step " << step;
    ASSERT_NEAR(world.set.commandedVolume(), commanded, 1e-9 * commanded + 1e-18);
    if (step % 25 == 0) { ASSERT_GE(world.nearestPair(), 0.999 * kDx) << "step " << step; }
  }
  EXPECT_GT(world.emitted, 20u);
  EXPECT_EQ(world.emitted, world.set.emittedParticles());
  EXPECT_EQ(world.seen_crossing, world.emitted);  // every emitted particle was seen to cross, once
  EXPECT_EQ(world.refused, 0u);
  std::uint64_t emerging = 0;
  for (const auto& [tag, state] : world.tagged) emerging += state.phase == InletPhase::emerging ? 1 : 0;
  EXPECT_EQ(world.released + emerging, world.emitted);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ThroatEmission,
    testing::Values(EmissionCase{"Disc", DiscPatch{0.003}, 8e-6}, EmissionCase{"SingleFile", DiscPatch{0.0004}, 2.4e-7},
                    EmissionCase{"Ellipse", EllipsePatch{0.004, 0.0004}, 2e-6},
                    EmissionCase{"Polygon", PolygonPatch{{{0, 0}, {0.006, 0.001}, {0.005, 0.005}, {0.001, 0.003}}}, 5e-6},
                    EmissionCase{"Incision", PolylinePatch{{{-0.005, 0}, {0.002, 0.001}, {0.004, 0.006}}, 0.0012}, 4e-6}),
    [](const testing::TestParamInfo<EmissionCase>& param_info) { return param_info.param.name; });

TEST(Throat, StateGoesFromThroatToEmergingToReleased) {
  const auto frame = makePatchFrame(Vec3::Zero(), {0, 0, 1}, Vec3::Zero());
  auto patch = makePatchSites(DiscPatch{0.0003}, kDx);
  ASSERT_TRUE(frame.ok() && patch.ok());
  Throat throat{3, *frame, *patch, kDx, 2.0 * kDx};
  EXPECT_TRUE(throat.sparse());
  throat.setRate(100.0);  // particles per second
  std::vector<std::uint32_t> tags;
  const auto keep = [&](const InletSpawn& spawn) {
    tags.push_back(spawn.tag);
    return true;
  };
  const double gap = kVolume / patch->area;
  EXPECT_NEAR(throat.gap(), gap, 1e-12);
  EXPECT_NEAR(throat.columnSpeed(), 100.0 * gap, 1e-12);
  const double to_start = 1.0 / 100.0;
  EXPECT_EQ(throat.advance(0.999 * to_start, keep).emitted, 0u);
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(throat.kinematics(unpackInletTag(tags[0])).phase, InletPhase::throat);
  EXPECT_EQ(throat.advance(0.002 * to_start, keep).emitted, 1u);
  EXPECT_EQ(throat.kinematics(unpackInletTag(tags[0])).phase, InletPhase::emerging);
  EXPECT_EQ(throat.advance(0.6 * kDx / throat.columnSpeed(), keep).emitted, 0u);
  const InletState out = throat.kinematics(unpackInletTag(tags[0]));
  EXPECT_EQ(out.phase, InletPhase::released);
  EXPECT_NEAR(out.velocity.z(), throat.columnSpeed(), 1e-12);
}

TEST(Throat, RefusedParticlesAreCountedWhenTheyWouldHaveCrossed) {
  ThroatWorld world{plainDescription(), 60};
  ASSERT_TRUE(world.set.add(discWound(0.003, 4e-6)).ok());
  world.step(0.0);
  EXPECT_EQ(world.tagged.size(), 60u);
  EXPECT_EQ(world.refused, 0u);  // nothing has crossed yet
  const std::uint64_t present = world.set.throat(1)->unseen();
  EXPECT_EQ(present, 60u);
  for (int step = 0; step < 2000; ++step) {
    world.step(1e-4);
    const double column = world.set.throat(1)->column();
    ASSERT_EQ(world.set.emittedParticles() + world.set.refusedParticles(), static_cast<std::uint64_t>(std::floor(column)));
  }
  EXPECT_GT(world.refused, 50u);
  EXPECT_GT(world.emitted, 50u);
  EXPECT_EQ(world.refused, world.set.refusedParticles());
  EXPECT_EQ(world.seen_crossing, world.emitted);
}

TEST(Throat, OpensTheTissueWhereItsParticlesStand) {
  const auto frame = makePatchFrame(Vec3::Zero(), {0, 0, 1}, Vec3::Zero());
  auto patch = makePatchSites(DiscPatch{0.008}, kDx);
  ASSERT_TRUE(frame.ok() && patch.ok());
  const double h = 2.0 * kDx;
  Throat throat{1, *frame, *patch, kDx, h};
  EXPECT_EQ(throat.openFraction(Vec3::Zero()), 0.0) << "nothing stands there before the first step";
  throat.advance(0.0, [](const InletSpawn&) { return true; });
  for (double x = 0.0; x < 0.005; x += 1.3e-4) EXPECT_GT(throat.openFraction({x, 0.3 * x, 1e-4}), 0.99) << x;
  EXPECT_NEAR(throat.openFraction({0.008, 0.0, 0.0}), 0.5, 0.2);
  EXPECT_EQ(throat.openFraction({0.008 + 1.01 * h, 0.0, 0.0}), 0.0);
  EXPECT_EQ(throat.openFraction({0.0, 0.0, 1.01 * h}), 0.0);
  EXPECT_EQ(throat.openFraction({0.0, 0.0, -throat.depth() - kDx}), 0.0);
  double before = 1.0;
  for (double x = 0.0; x < 0.012; x += 1e-5) {
    const double open = throat.openFraction({x, 0.0, 0.0});
    EXPECT_LT(std::abs(open - before), 0.02) << "not smooth at " << x;
    before = open;
  }
}

TEST(Throat, AHoleOrASparseColumnKeepsTheTissueClosed) {
  const auto frame = makePatchFrame(Vec3::Zero(), {0, 0, 1}, Vec3::Zero());
  auto wide = makePatchSites(DiscPatch{0.004}, kDx);
  auto thin = makePatchSites(DiscPatch{0.0003}, kDx);
  ASSERT_TRUE(frame.ok() && wide.ok() && thin.ok());
  Throat starved{1, *frame, *wide, kDx, 2.0 * kDx};
  starved.advance(0.0, [](const InletSpawn&) { return false; });
  EXPECT_EQ(starved.openFraction(Vec3::Zero()), 0.0);
  EXPECT_EQ(starved.unseen(), 0u);
  Throat jet{2, *frame, *thin, kDx, 2.0 * kDx};
  jet.advance(0.0, [](const InletSpawn&) { return true; });
  EXPECT_EQ(jet.openFraction(Vec3::Zero()), 0.0);
}

}  // namespace
}  // namespace bleedsim::sph
