#include "clients/lib/request_builder.h"

#include <gtest/gtest.h>

#include "service/status/request_limits.h"

namespace bleedsim::client {
namespace {

TEST(RequestBuilder, OwnsTheOutlineAndText) {
  RequestPointer wound;
  {
    WoundSpec spec{.name = "w", .shape = WoundShape::polyline, .width_m = 0.001};
    spec.outline = {0.0, 0.0, 0.01, 0.02};
    wound = buildAddWound(spec).value();
  }
  const bleed_v1_Wound& wire = wound->wire.body._u.wound_add;
  EXPECT_EQ(wound->wire.body._d, std::uint32_t{bleed_v1_REQUEST_WOUND_ADD});
  ASSERT_EQ(wire.outline._length, 4U);
  EXPECT_EQ(wire.outline._buffer[3], 0.02);
  EXPECT_EQ(wire.shape, std::uint32_t{bleed_v1_SHAPE_POLYLINE});
  const RequestPointer load = buildLoadScene(std::string(1000, 'x')).value();
  EXPECT_EQ(std::string{load->wire.body._u.load_scene.text}.size(), 1000U);
}

TEST(RequestBuilder, ChoosesTheDrive) {
  const auto flow = buildAddWound({.flow_ml_per_s = 2.0});
  EXPECT_EQ((*flow)->wire.body._u.wound_add.drive, std::uint32_t{bleed_v1_DRIVE_FLOW});
  WoundSpec spec;
  spec.pressure_mmhg = 80.0;
  const auto pressure = buildAddWound(spec);
  EXPECT_EQ((*pressure)->wire.body._u.wound_add.drive, std::uint32_t{bleed_v1_DRIVE_PRESSURE});
  EXPECT_EQ((*pressure)->wire.body._u.wound_add.pressure_mmhg, 80.0);
}

TEST(RequestBuilder, MarksExactlyTheChangedFields) {
  WoundChange change;
  change.position = Vec3{1, 2, 3};
  change.flow_ml_per_s = 4.0;
  const auto built = buildUpdateWound(8, change);
  const bleed_v1_WoundUpdate& update = (*built)->wire.body._u.wound_update;
  EXPECT_EQ(update.wound_id, 8U);
  EXPECT_EQ(update.fields, std::uint32_t{bleed_v1_WOUND_FIELD_POSITION | bleed_v1_WOUND_FIELD_DRIVE});
  EXPECT_EQ(update.wound.position.z, 3.0);
  EXPECT_EQ(update.wound.flow_ml_per_s, 4.0);
}

TEST(RequestBuilder, RefusesWhatTheWireCannotCarry) {
  EXPECT_EQ(buildAddWound({.name = std::string(65, 'n')}).status().code(), StatusCode::invalid_argument);
  WoundSpec spec;
  spec.outline.resize(513);
  EXPECT_EQ(buildAddWound(spec).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(buildUpdateWound(1, {}).status().code(), StatusCode::invalid_argument);
  WoundChange both;
  both.flow_ml_per_s = 1.0;
  both.pressure_mmhg = 1.0;
  EXPECT_EQ(buildUpdateWound(1, both).status().code(), StatusCode::invalid_argument);
  EXPECT_EQ(buildLoadScene(std::string("a\0b", 3)).status().code(), StatusCode::invalid_argument);
  EXPECT_TRUE(buildLoadScene(std::string(kMaxSceneBytes, ' ')).ok());
  EXPECT_EQ(buildLoadScene(std::string(kMaxSceneBytes + 1, ' ')).status().code(), StatusCode::invalid_argument);
  OutputSpec output;
  output.attributes = {"velocity", "colour"};
  EXPECT_EQ(buildOutput(output).status().code(), StatusCode::invalid_argument);
}

TEST(RequestBuilder, RefusesANameThatIsNotPrintableUtf8) {
  for (const char* name : {"caf\xe9", "a\nb", "\xc0\xaf", "\xed\xa0\x80", "cut \xe2\x82"}) {
    const auto added = buildAddWound({.name = name});
    EXPECT_EQ(added.status().code(), StatusCode::invalid_argument) << name;
    EXPECT_NE(added.status().message().find("byte "), std::string::npos) << added.status().message();
    WoundChange change;
    change.name = name;
    EXPECT_EQ(buildUpdateWound(1, change).status().code(), StatusCode::invalid_argument) << name;
  }
  EXPECT_TRUE(buildAddWound({.name = "caf\xc3\xa9"}).ok());
}

TEST(RequestBuilder, NamesAttributesAsBits) {
  OutputSpec output{.rate_hz = 30.0};
  EXPECT_FALSE(buildOutput(output).value()->wire.body._u.output.set_attributes);
  output.attributes = {"velocity", "density"};
  const auto built = buildOutput(output);
  EXPECT_TRUE((*built)->wire.body._u.output.set_attributes);
  EXPECT_EQ((*built)->wire.body._u.output.attributes, 1U << bleed_v1_SEMANTIC_VELOCITY | 1U << bleed_v1_SEMANTIC_DENSITY);
}

TEST(RequestBuilder, FillsAnEffect) {
  const auto built = buildEffect("surface_tension", true, "sigma_n_per_m: 0.06");
  ASSERT_TRUE(built.ok());
  EXPECT_EQ((*built)->wire.body._d, std::uint32_t{bleed_v1_REQUEST_EFFECT});
  EXPECT_STREQ((*built)->wire.body._u.effect.name, "surface_tension");
  EXPECT_TRUE((*built)->wire.body._u.effect.enabled);
  EXPECT_STREQ((*built)->wire.body._u.effect.settings, "sigma_n_per_m: 0.06");
  EXPECT_FALSE(buildEffect("gravity", false, "").value()->wire.body._u.effect.enabled);
}

TEST(RequestBuilder, RefusesAnEffectThatDoesNotFit) {
  EXPECT_FALSE(buildEffect("", true, "").ok());
  EXPECT_TRUE(buildEffect(std::string(32, 'x'), true, std::string(2048, ' ')).ok());
  EXPECT_FALSE(buildEffect(std::string(33, 'x'), true, "").ok());
  const auto long_text = buildEffect("gravity", true, std::string(2049, ' '));
  EXPECT_EQ(long_text.status().code(), StatusCode::invalid_argument);
  EXPECT_NE(long_text.status().message().find("at most 2048"), std::string::npos) << long_text.status().message();
  EXPECT_FALSE(buildEffect("gravity", true, std::string("a\0b", 3)).ok());
}

}  // namespace
}  // namespace bleedsim::client
