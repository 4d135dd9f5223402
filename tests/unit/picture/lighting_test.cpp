// Light, and linear against sRGB colours.
#include "service/picture/lighting.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::picture::test {
namespace {

TEST(Lighting, diffuseIsBrightestWhereTheNormalMeetsTheLight) {
  const Light light{{-0.3F, 0.5F, -0.8F}, 0.3F, 0.7F};
  const Eigen::Vector3f towards = light.towards.normalized();
  const Eigen::Vector3f to_eye{0, 0, -1};
  const float best = lightOn(towards, to_eye, light, {0.0F, 1.0F}).diffuse;
  EXPECT_NEAR(best, light.key, 1e-6F);
  for (int i = 0; i < 500; ++i) {
    // Points of a Fibonacci sphere.
    const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / 500.0F;
    const float angle = 2.399963F * static_cast<float>(i);
    const float across = std::sqrt(1.0F - z * z);
    const Eigen::Vector3f normal{across * std::cos(angle), across * std::sin(angle), z};
    const Lit lit = lightOn(normal, to_eye, light, {0.4F, 30.0F});
    // Lambert: the cosine of the angle to the light, nothing behind.
    EXPECT_NEAR(lit.diffuse, light.key * std::max(0.0F, normal.dot(towards)), 1e-5F);
    EXPECT_LE(lit.diffuse, best + 1e-6F);
    EXPECT_GE(lit.ambient, 0.0F);
    if (normal.dot(towards) <= 0.0F) { EXPECT_EQ(lit.specular, 0.0F); }
  }
}

TEST(Lighting, specularIsBrightestHalfWayToTheEye) {
  const Light light{{-0.6F, 0.0F, -0.8F}};
  const Eigen::Vector3f to_eye{0, 0, -1};
  const Material material{0.5F, 60.0F};
  const Eigen::Vector3f half = (light.towards.normalized() + to_eye).normalized();
  EXPECT_NEAR(lightOn(half, to_eye, light, material).specular, material.specular, 1e-5F);
  EXPECT_LT(lightOn(to_eye, to_eye, light, material).specular, 0.5F * material.specular);
  EXPECT_LT(lightOn(light.towards.normalized(), to_eye, light, material).specular, 0.5F * material.specular);
}

TEST(Lighting, wetSurfaceMirrorsTheLightAndMoreAtASlant) {
  const Light light{{-0.6F, 0.0F, -0.8F}};
  const Eigen::Vector3f to_eye{0, 0, -1};
  const Eigen::Vector3f half = (light.towards.normalized() + to_eye).normalized();
  EXPECT_GT(mirrored(half, to_eye, light), 5.0F * mirrored(to_eye, to_eye, light));
  const Eigen::Vector3f slanted = Eigen::Vector3f{0.99F, 0.0F, -0.14F}.normalized();
  EXPECT_GT(mirrored(slanted, to_eye, light), 5.0F * mirrored(to_eye, to_eye, light));
}

TEST(Lighting, everySrgbColorSurvivesTheWayThroughLinear) {
  for (int value = 0; value < 256; ++value) {
    const auto v = static_cast<std::uint8_t>(value);
    EXPECT_EQ(toSrgb(toLinear({v, 0, 255})), (Color{v, 0, 255}));
  }
}

TEST(Lighting, colorsBeyondTheScreenAreBounded) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(toSrgb({2.0F, -1.0F, nan}), (Color{255, 0, 0}));
}

}  // namespace
}  // namespace bleedsim::picture::test
