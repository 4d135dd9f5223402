#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "service/dds/decode.h"
#include "service/status/units.h"
#include "tests/unit/dds/samples.h"

namespace bleedsim::dds {
namespace {

using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct BadWound {
  const char* name;
  std::function<void(bleed_v1_Wound&)> spoil;
  const char* field;  // named by the message
};

class BadWoundTest : public testing::TestWithParam<BadWound> {};

TEST_P(BadWoundTest, IsRefusedByNameOfTheField) {
  bleed_v1_Wound sample = discWound();
  GetParam().spoil(sample);
  const auto wound = decodeWound(sample);
  ASSERT_FALSE(wound.ok());
  EXPECT_EQ(wound.status().code(), StatusCode::invalid_argument);
  EXPECT_THAT(wound.status().message(), HasSubstr(GetParam().field));
  EXPECT_THAT(wound.status().message(), HasSubstr("use "));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadWoundTest,
    testing::Values(BadWound{"nan_position", [](auto& w) { w.position.y = kNaN; }, "wound.position.y"},
                    BadWound{"infinite_position", [](auto& w) { w.position.x = -kInfinity; }, "wound.position.x"},
                    BadWound{"huge_position", [](auto& w) { w.position.z = 10.5; }, "wound.position.z is 10.5: use -10 to 10 m"},
                    BadWound{"nan_normal", [](auto& w) { w.normal.x = kNaN; }, "wound.normal.x"},
                    BadWound{"zero_normal",
                             [](auto& w) {
                               w.normal = {0.0, 0.0, 0.0};
                             },
                             "wound.normal"},
                    BadWound{"nan_tangent", [](auto& w) { w.tangent.z = kNaN; }, "wound.tangent.z"},
                    BadWound{"tiny_tangent", [](auto& w) { w.tangent.z = 1e-9; }, "wound.tangent"},
                    BadWound{"unknown_shape", [](auto& w) { w.shape = 4; }, "wound.shape is 4"},
                    BadWound{"zero_radius", [](auto& w) { w.radius_m = 0.0; }, "wound.radius_m"},
                    BadWound{"negative_radius", [](auto& w) { w.radius_m = -0.003; }, "wound.radius_m"},
                    BadWound{"nan_radius", [](auto& w) { w.radius_m = kNaN; }, "wound.radius_m"},
                    BadWound{"huge_radius", [](auto& w) { w.radius_m = 0.11; }, "wound.radius_m is 0.11: use 1e-05 to 0.1 m"},
                    BadWound{"ellipse_without_second_axis", [](auto& w) { w.shape = bleed_v1_SHAPE_ELLIPSE; }, "wound.radius2_m"},
                    BadWound{"polygon_without_outline", [](auto& w) { w.shape = bleed_v1_SHAPE_POLYGON; }, "wound.outline"},
                    BadWound{"polyline_without_width", [](auto& w) { w.shape = bleed_v1_SHAPE_POLYLINE; }, "wound.width_m"},
                    BadWound{"unknown_drive", [](auto& w) { w.drive = 2; }, "wound.drive is 2"},
                    BadWound{"negative_flow", [](auto& w) { w.flow_ml_per_s = -1.0; }, "wound.flow_ml_per_s"},
                    BadWound{"nan_flow", [](auto& w) { w.flow_ml_per_s = kNaN; }, "wound.flow_ml_per_s"},
                    BadWound{"huge_flow", [](auto& w) { w.flow_ml_per_s = 1001.0; },
                             "wound.flow_ml_per_s is 1001: use 0 to 1000 mL/s"},
                    BadWound{"nan_pressure",
                             [](auto& w) {
                               w.drive = bleed_v1_DRIVE_PRESSURE;
                               w.pressure_mmhg = kNaN;
                             },
                             "wound.pressure_mmhg"},
                    BadWound{"huge_pressure",
                             [](auto& w) {
                               w.drive = bleed_v1_DRIVE_PRESSURE;
                               w.pressure_mmhg = 1001.0;
                             },
                             "wound.pressure_mmhg is 1001: use 0 to 1000 mmHg"},
                    BadWound{"small_discharge",
                             [](auto& w) {
                               w.drive = bleed_v1_DRIVE_PRESSURE;
                               w.discharge_coefficient = 0.05;
                             },
                             "wound.discharge_coefficient is 0.05: use 0.1 to 1 or 0 for the default"},
                    BadWound{"discharge_above_one",
                             [](auto& w) {
                               w.drive = bleed_v1_DRIVE_PRESSURE;
                               w.discharge_coefficient = 1.5;
                             },
                             "wound.discharge_coefficient"},
                    BadWound{"control_character", [](auto& w) { copyText("a\nb", w.name); }, "wound.name"},
                    BadWound{"not_utf8", [](auto& w) { copyText("caf\xe9", w.name); }, "wound.name"},
                    BadWound{"overlong", [](auto& w) { copyText("\xc0\xaf", w.name); }, "wound.name"},
                    BadWound{"surrogate", [](auto& w) { copyText("\xed\xa0\x80", w.name); }, "wound.name"}),
    [](const auto& tested) { return std::string{tested.param.name}; });

TEST(DecodeWound, ConvertsToSiUnits) {
  bleed_v1_Wound sample = discWound();
  auto wound = decodeWound(sample);
  ASSERT_TRUE(wound.ok()) << wound.status().message();
  EXPECT_EQ(wound->name, "cut");
  EXPECT_DOUBLE_EQ(wound->normal.norm(), 1.0);
  EXPECT_DOUBLE_EQ(std::get<sph::FlowDrive>(wound->drive).flow, 2e-6);
  EXPECT_DOUBLE_EQ(std::get<sph::DiscPatch>(wound->shape).radius, 0.003);

  sample.drive = bleed_v1_DRIVE_PRESSURE;
  sample.pressure_mmhg = 80.0;
  wound = decodeWound(sample);
  ASSERT_TRUE(wound.ok());
  EXPECT_NEAR(std::get<sph::PressureDriveSettings>(wound->drive).inlet_pressure, 10665.79, 0.01);
  EXPECT_DOUBLE_EQ(std::get<sph::PressureDriveSettings>(wound->drive).discharge_coefficient, 0.61);
}

TEST(DecodeWound, ReadsAnOutlineAsPairs) {
  std::vector<double> outline{-0.01, 0.0, 0.0, 0.001, 0.01, 0.0};
  bleed_v1_Wound sample = discWound();
  sample.shape = bleed_v1_SHAPE_POLYLINE;
  sample.width_m = 0.002;
  sample.outline = {6, 6, outline.data(), false};
  const auto wound = decodeWound(sample);
  ASSERT_TRUE(wound.ok()) << wound.status().message();
  const auto& patch = std::get<sph::PolylinePatch>(wound->shape);
  ASSERT_EQ(patch.points.size(), 3U);
  EXPECT_EQ(patch.points[1], sph::Vec2(0.0, 0.001));
}

TEST(DecodeWound, RefusesBadOutlines) {
  std::vector<double> outline(1030, 0.001);
  bleed_v1_Wound sample = discWound();
  sample.shape = bleed_v1_SHAPE_POLYGON;
  for (const std::uint32_t length : {1U, 4U, 7U, 514U, 1030U}) {
    sample.outline = {length, length, outline.data(), false};
    EXPECT_FALSE(decodeWound(sample).ok()) << length;
  }
  sample.outline = {8, 8, nullptr, false};
  EXPECT_FALSE(decodeWound(sample).ok());
  sample.outline = {8, 8, outline.data(), false};
  EXPECT_TRUE(decodeWound(sample).ok());
  outline[5] = kNaN;
  const auto wound = decodeWound(sample);
  ASSERT_FALSE(wound.ok());
  EXPECT_THAT(wound.status().message(), HasSubstr("wound.outline[2].v"));
}

TEST(DecodeWoundUpdate, ReadsOnlyTheNamedMembers) {
  bleed_v1_WoundUpdate sample{5, bleed_v1_WOUND_FIELD_DRIVE, discWound(), ""};
  sample.wound.position.x = kNaN;
  sample.wound.shape = 99;
  const auto update = decodeWoundUpdate(sample);
  ASSERT_TRUE(update.ok()) << update.status().message();
  EXPECT_EQ(update->wound_id, 5U);
  EXPECT_TRUE(update->drive.has_value());
  EXPECT_FALSE(update->position || update->normal || update->tangent || update->shape || update->name);

  sample.fields = bleed_v1_WOUND_FIELD_POSITION;
  EXPECT_FALSE(decodeWoundUpdate(sample).ok());
}

TEST(DecodeWoundUpdate, RefusesNoMemberAndUnknownMembers) {
  EXPECT_FALSE(decodeWoundUpdate({5, 0, discWound(), ""}).ok());
  EXPECT_FALSE(decodeWoundUpdate({5, 32, discWound(), ""}).ok());
}

}  // namespace
}  // namespace bleedsim::dds
