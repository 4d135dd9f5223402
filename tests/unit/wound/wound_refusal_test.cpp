#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "tests/unit/wound/throat_world.h"

namespace bleedsim::sph {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Spoiled {
  const char* says;  ///< what the message must name
  std::function<void(WoundDescription&)> spoil;
};

std::vector<Spoiled> spoiledWounds() {
  return {
      {"position", [](WoundDescription& w) { w.position.x() = kNan; }},
      {"position", [](WoundDescription& w) { w.position.z() = kInf; }},
      {"outside the domain", [](WoundDescription& w) { w.position.x() = 0.051; }},
      {"outside the domain", [](WoundDescription& w) { w.position.z() = -1e300; }},
      {"out of the domain", [](WoundDescription& w) { w.position.y() = 0.0499; }},
      {"normal", [](WoundDescription& w) { w.normal = Vec3::Zero(); }},
      {"normal", [](WoundDescription& w) { w.normal.y() = kNan; }},
      {"tangent", [](WoundDescription& w) { w.tangent.y() = kInf; }},
      {"radius", [](WoundDescription& w) { w.shape = DiscPatch{0.0}; }},
      {"radius", [](WoundDescription& w) { w.shape = DiscPatch{kNan}; }},
      {"257 points",
       [](WoundDescription& w) {
         w.shape = PolylinePatch{std::vector<Vec2>(257, Vec2::Zero()), 0.001};
       }},
      {"crosses itself",
       [](WoundDescription& w) {
         w.shape = PolygonPatch{{{0, 0}, {0.01, 0.01}, {0.01, 0}, {0, 0.01}}};
       }},
      {"flow", [](WoundDescription& w) { w.drive = FlowDrive{-1e-6}; }},
      {"flow", [](WoundDescription& w) { w.drive = FlowDrive{kNan}; }},
      {"pressure",
       [](WoundDescription& w) {
         w.drive = PressureDriveSettings{kInf, 0.61};
       }},
      {"discharge",
       [](WoundDescription& w) {
         w.drive = PressureDriveSettings{100.0, 2.0};
       }},
      {"design_speed_m_per_s of at least", [](WoundDescription& w) { w.drive = FlowDrive{1e-3}; }},
      {"inlet pressure at most",
       [](WoundDescription& w) {
         w.drive = PressureDriveSettings{1e5, 0.61};
       }},
      {"overlaps wound 1",
       [](WoundDescription& w) {
         w.position = {0.0005, 0, 0};
       }},
      {"name", [](WoundDescription& w) { w.name.assign(5000, 'x'); }},
      {"name 'medial' is already that of wound 1", [](WoundDescription& w) { w.name = "medial"; }},
  };
}

/// Everything of the set that an accepted change would alter.
std::string fingerprint(const ThroatWorld& world) {
  std::string text;
  for (const WoundState& state : world.set.states()) {
    const WoundDescription* wound = world.set.description(state.id);
    const Throat* throat = world.set.throat(state.id);
    std::ostringstream out;
    out.precision(17);
    out << state.id << ' ' << state.emitted << ' ' << state.flow << ' ' << wound->name << ' ' << wound->position.transpose()
        << ' ' << wound->normal.transpose() << ' ' << wound->shape.index() << ' ' << patchArea(wound->shape) << ' '
        << throat->column() << ' ' << throat->columnSpeed() << ' ' << throat->unseen() << '\n';
    text += out.str();
  }
  for (const auto& [tag, state] : world.tagged) {
    std::ostringstream out;
    out.precision(17);
    out << tag << ' ' << world.set.kinematics(tag).position.transpose() << '\n';
    text += out.str();
  }
  return text;
}

class WoundRefusal : public testing::Test {
 protected:
  WoundRefusal() : world_{plainDescription()} {
    WoundDescription first = discWound(0.003, 5e-6);
    first.name = "medial";
    EXPECT_TRUE(world_.set.add(first).ok());
    WoundDescription second = discWound(0.003, 2e-6);
    second.position = {0.02, 0, 0};
    EXPECT_TRUE(world_.set.add(second).ok());
    for (int step = 0; step < 50; ++step) world_.step(1e-4);
  }
  ThroatWorld world_;
};

TEST_F(WoundRefusal, ABadWoundIsNotAdded) {
  const std::string before = fingerprint(world_);
  for (const Spoiled& bad : spoiledWounds()) {
    WoundDescription wound = discWound(0.003, 1e-6);
    wound.position = {-0.02, 0, 0};
    bad.spoil(wound);
    const auto added = world_.set.add(wound);
    ASSERT_FALSE(added.ok()) << bad.says;
    EXPECT_EQ(added.status().code(), StatusCode::invalid_argument) << added.status().message();
    EXPECT_NE(added.status().message().find(bad.says), std::string::npos) << added.status().message() << " lacks " << bad.says;
    EXPECT_EQ(fingerprint(world_), before) << bad.says;
  }
  WoundDescription good = discWound(0.003, 1e-6);
  good.position = {-0.02, 0, 0};
  const auto added = world_.set.add(good);
  ASSERT_TRUE(added.ok()) << added.status().message();
  EXPECT_EQ(*added, 3u) << "refused wounds must not use up ids";
}

TEST_F(WoundRefusal, ABadChangeChangesNothing) {
  const std::string before = fingerprint(world_);
  for (const Spoiled& bad : spoiledWounds()) {
    WoundDescription wound = *world_.set.description(2);
    bad.spoil(wound);
    const UpdateWound change{.wound_id = 2,
                             .name = wound.name,
                             .position = wound.position,
                             .normal = wound.normal,
                             .tangent = wound.tangent,
                             .shape = wound.shape,
                             .drive = wound.drive};
    bool withdrew = false;
    const Status status = world_.set.update(change, [&](const Throat&) { withdrew = true; });
    EXPECT_EQ(status.code(), StatusCode::invalid_argument) << bad.says << ": " << status.message();
    EXPECT_NE(status.message().find(bad.says), std::string::npos) << status.message() << " lacks " << bad.says;
    EXPECT_FALSE(withdrew) << bad.says;
    EXPECT_EQ(fingerprint(world_), before) << bad.says;
  }
}

TEST_F(WoundRefusal, UnknownIdsAreNamedWithTheKnownOnes) {
  const std::string before = fingerprint(world_);
  for (const std::uint32_t id : {0u, 3u, 0xffffffffu}) {
    const Status removed = world_.set.remove(id, world_.withdrawing());
    EXPECT_EQ(removed.code(), StatusCode::not_found);
    EXPECT_NE(removed.message().find("the wounds now are 1, 2"), std::string::npos) << removed.message();
    EXPECT_EQ(world_.set.update(driveChange(id, FlowDrive{0.0}), world_.withdrawing()).code(), StatusCode::not_found);
  }
  EXPECT_EQ(fingerprint(world_), before);
}

TEST_F(WoundRefusal, PatchTooWideForAPeriodicSide) {
  WorldDescription description = plainDescription();
  description.domain.lower = {-0.006, -0.05, -0.05};
  description.domain.upper = {0.006, 0.05, 0.05};
  description.domain.periodic = {true, false, false};
  WoundSet set{description, 5.0};
  EXPECT_TRUE(set.add(discWound(0.004, 1e-6)).ok());
  WoundSet narrow{description, 5.0};
  const auto added = narrow.add(discWound(0.0065, 1e-6));
  ASSERT_FALSE(added.ok());
  EXPECT_NE(added.status().message().find("periodic"), std::string::npos) << added.status().message();
}

}  // namespace
}  // namespace bleedsim::sph
