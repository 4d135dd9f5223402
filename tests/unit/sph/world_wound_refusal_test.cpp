// What World::apply refuses of wounds, and that a refusal leaves no trace.
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "tests/support/scenes.h"

namespace bleedsim::sph {
namespace {

constexpr double kMlPerSecond = 1e-6;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Refusal {
  const char* what;
  Command command;
  StatusCode code;
};

AddWound wound(const std::function<void(WoundDescription&)>& change) {
  WoundDescription description = test::discWound(0.002, 1e-6);
  description.position = {0.012, 0.0, 0.0};
  change(description);
  return {description};
}

UpdateWound update(const std::function<void(UpdateWound&)>& change, std::uint32_t id = 1) {
  UpdateWound changed;
  changed.wound_id = id;
  change(changed);
  return changed;
}

std::vector<Refusal> refusals() {
  using W = WoundDescription;
  using U = UpdateWound;
  constexpr StatusCode kBad = StatusCode::invalid_argument;
  std::vector<Refusal> all{
      {"position outside", wound([](W& w) { w.position.z() = 0.2; }), kBad},
      {"patch across the side", wound([](W& w) { w.position.x() = 0.0495; }), kBad},
      {"zero normal", wound([](W& w) { w.normal = Vec3::Zero(); }), kBad},
      {"negative flow", wound([](W& w) { w.drive = FlowDrive{-1e-9}; }), kBad},
      {"too fast", wound([](W& w) { w.drive = FlowDrive{1e-4}; }), kBad},
      {"huge flow", wound([](W& w) { w.drive = FlowDrive{1e300}; }), kBad},
      {"negative pressure", wound([](W& w) {
         w.drive = PressureDriveSettings{-1.0, 0.6};
       }),
       kBad},
      {"pressure too high", wound([](W& w) {
         w.drive = PressureDriveSettings{1e9, 0.6};
       }),
       kBad},
      {"discharge 0", wound([](W& w) {
         w.drive = PressureDriveSettings{1.0, 0.0};
       }),
       kBad},
      {"discharge above 1", wound([](W& w) {
         w.drive = PressureDriveSettings{1.0, 1.1};
       }),
       kBad},
      {"radius 0", wound([](W& w) { w.shape = DiscPatch{0.0}; }), kBad},
      {"radius huge", wound([](W& w) { w.shape = DiscPatch{1e9}; }), kBad},
      {"two corners", wound([](W& w) {
         w.shape = PolygonPatch{{{0.0, 0.0}, {0.001, 0.0}}};
       }),
       kBad},
      {"one point", wound([](W& w) {
         w.shape = PolylinePatch{{{0.0, 0.0}}, 0.001};
       }),
       kBad},
      {"long name", wound([](W& w) { w.name.assign(10'000, 'x'); }), kBad},
      {"over the first", wound([](W& w) {
         w.position = {0.001, 0.0, 0.0};
       }),
       kBad},
      {"inside the tissue", wound([](W& w) { w.position.z() = -0.002; }), kBad},
      {"normal into the tissue", wound([](W& w) { w.normal = -Vec3::UnitZ(); }), kBad},
      {"update into the tissue", update([](U& u) {
         u.position = Vec3{0.0, 0.0, -0.002};
       }),
       kBad},
      {"update normal into the tissue", update([](U& u) { u.normal = -Vec3::UnitZ(); }), kBad},
      {"update outside", update([](U& u) {
         u.position = Vec3{0.0, 1.0, 0.0};
       }),
       kBad},
      {"update zero normal", update([](U& u) { u.normal = Vec3::Zero(); }), kBad},
      {"update radius", update([](U& u) { u.shape = DiscPatch{-1.0}; }), kBad},
      {"update too fast", update([](U& u) { u.drive = FlowDrive{1e-3}; }), kBad},
      {"update good and bad", update([](U& u) {
         u.position = Vec3{0.002, 0.0, 0.0}, u.drive = FlowDrive{kNan};
       }),
       kBad},
      {"update unknown", update([](U& u) { u.drive = FlowDrive{1e-6}; }, 7), StatusCode::not_found},
      {"update id 0", update([](U& u) { u.drive = FlowDrive{1e-6}; }, 0), StatusCode::not_found},
      {"remove unknown", RemoveWound{2}, StatusCode::not_found},
      {"remove id 0", RemoveWound{0}, StatusCode::not_found},
      {"remove largest id", RemoveWound{0xffffffffu}, StatusCode::not_found},
  };
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    all.push_back({"position not finite", wound([bad](W& w) { w.position.y() = bad; }), kBad});
    all.push_back({"normal not finite", wound([bad](W& w) { w.normal.x() = bad; }), kBad});
    all.push_back({"tangent not finite", wound([bad](W& w) { w.tangent.x() = bad; }), kBad});
    all.push_back({"flow not finite", wound([bad](W& w) { w.drive = FlowDrive{bad}; }), kBad});
    all.push_back({"pressure not finite", wound([bad](W& w) { w.drive = PressureDriveSettings{bad, 0.6}; }), kBad});
    all.push_back({"discharge not finite", wound([bad](W& w) { w.drive = PressureDriveSettings{1.0, bad}; }), kBad});
    all.push_back({"radius not finite", wound([bad](W& w) { w.shape = DiscPatch{bad}; }), kBad});
    all.push_back({"axis not finite", wound([bad](W& w) { w.shape = EllipsePatch{0.001, bad}; }), kBad});
    all.push_back({"point not finite", wound([bad](W& w) { w.shape = PolygonPatch{{{0, 0}, {0.002, 0}, {0, bad}}}; }), kBad});
    all.push_back({"width not finite", wound([bad](W& w) { w.shape = PolylinePatch{{{0, 0}, {0.002, 0}}, bad}; }), kBad});
    all.push_back({"update position not finite", update([bad](U& u) { u.position = Vec3{bad, 0.0, 0.0}; }), kBad});
    all.push_back({"update pressure not finite", update([bad](U& u) { u.drive = PressureDriveSettings{bad, 0.6}; }), kBad});
  }
  return all;
}

TEST(WorldWoundRefusals, TheySayWhyAndChangeNothing) {
  const auto world = test::makeWorld(test::woundOnPlane(0.003, 6 * kMlPerSecond));
  const auto untouched = test::makeWorld(test::woundOnPlane(0.003, 6 * kMlPerSecond));
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    ASSERT_TRUE(untouched->step(1.0).ok());
  }
  const std::uint64_t hash = world->stateHash();
  ASSERT_EQ(hash, untouched->stateHash());
  for (const Refusal& refusal : refusals()) {
    const auto answer = world->apply(refusal.command);
    ASSERT_FALSE(answer.ok()) << refusal.what;
    EXPECT_EQ(answer.status().code(), refusal.code) << refusal.what << ": " << answer.status().message();
    EXPECT_GT(answer.status().message().size(), 20u) << refusal.what;
    ASSERT_EQ(world->stateHash(), hash) << refusal.what;
    ASSERT_EQ(world->wounds().size(), 1u) << refusal.what;
    ASSERT_DOUBLE_EQ(world->wounds()[0].flow, 6 * kMlPerSecond) << refusal.what;
  }
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(world->step(1.0).ok());
    ASSERT_TRUE(untouched->step(1.0).ok());
  }
  EXPECT_EQ(world->stateHash(), untouched->stateHash()) << "a refusal left a trace";
}

}  // namespace
}  // namespace bleedsim::sph
