// Whole pictures: what is seen where, in which colours, and which input is refused.
#include "service/picture/scene_picture.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::picture::test {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// From 1 m above, orthographic, 0.4 m x 0.3 m.
Camera fromTop() {
  Camera camera;
  camera.projection = Camera::Projection::orthographic;
  camera.eye = {0, 0, 1};
  camera.up = Vec3::UnitY();
  camera.width_m = 0.4;
  return camera;
}

/// 400 x 300 pixels with nothing on top.
SceneStyle plain() {
  SceneStyle style;
  style.width = 400;
  style.height = 300;
  style.samples = 1;
  style.grid = false;
  style.scale_bar = false;
  return style;
}

int brightness(Color color) { return color.r + color.g + color.b; }

bool isRed(Color color) { return color.r > 2 * color.g + 20 && color.r > 2 * color.b + 20; }

/// A layer of touching particles, `side` x `side`, on the plane z = 0.
std::vector<float> layer(int side, double radius) {
  std::vector<float> positions;
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      for (const double at : {(2 * i - side + 1) * radius, (2 * k - side + 1) * radius, radius})
        positions.push_back(static_cast<float>(at));
    }
  }
  return positions;
}

TEST(ScenePicture, bloodIsRedOnTissueBeforeABackground) {
  const std::vector<float> position{0, 0, 0.02F};
  const std::vector<Shape> tissue{PlaneShape{{0, 0, 0}, {0, 0, 1}, 0.1}};
  for (const BloodLook look : {BloodLook::spheres, BloodLook::liquid}) {
    SceneStyle style = plain();
    style.look = look;
    const Result<ScenePicture> picture = drawScene({.positions = position, .radius_m = 0.02}, tissue, fromTop(), style);
    ASSERT_TRUE(picture.ok()) << picture.status().message();
    EXPECT_TRUE(isRed(picture->image.at(203, 147)));
    const Color tissue_color = picture->image.at(280, 150);
    EXPECT_FALSE(isRed(tissue_color));
    EXPECT_GT(tissue_color.r, tissue_color.g);
    EXPECT_GT(tissue_color.g, tissue_color.b);
    const Color background = picture->image.at(320, 150);
    EXPECT_LT(std::abs(background.r - background.b), 20) << "the background is grey";
  }
}

TEST(ScenePicture, depthIsThatOfTheNearestSurface) {
  const std::vector<float> position{0, 0, 0.02F};
  const Result<ScenePicture> picture =
      drawScene({.positions = position, .radius_m = 0.02}, {PlaneShape{{0, 0, 0}, {0, 0, 1}, 0.1}}, fromTop(), plain());
  ASSERT_TRUE(picture.ok());
  const auto depth_at = [&picture](int x, int y) {
    return picture->depth_m[static_cast<std::size_t>(y) * 400 + static_cast<std::size_t>(x)];
  };
  // Half a pixel (0.5 mm) from the axis both ways: 0.98 m to the centre less sqrt(r^2 - 0.5 mm^2).
  EXPECT_NEAR(depth_at(200, 150), 0.98 - std::sqrt(0.02 * 0.02 - 0.5e-6), 1e-6);
  EXPECT_NEAR(depth_at(280, 150), 1.0, 1e-6);
  EXPECT_EQ(depth_at(320, 150), kNoDepth);
}

TEST(ScenePicture, tissueHidesWhatLiesBehindIt) {
  const std::vector<float> position{0, 0, -0.05F};
  const Result<ScenePicture> picture = drawScene({.positions = position, .radius_m = 0.02}, {PlaneShape{}}, fromTop(), plain());
  ASSERT_TRUE(picture.ok());
  EXPECT_FALSE(isRed(picture->image.at(200, 150)));
}

TEST(ScenePicture, sphereIsBrightestTowardsTheLight) {
  const std::vector<float> position{0, 0, 0};
  for (const Eigen::Vector2f& side : {Eigen::Vector2f{1, 0}, {-1, 0}, {0, 1}, {-0.6F, 0.8F}}) {
    SceneStyle style = plain();
    style.light.towards = {side.x(), side.y(), -1.0F};
    const Result<ScenePicture> picture = drawScene({.positions = position, .radius_m = 0.1}, {}, fromTop(), style);
    ASSERT_TRUE(picture.ok());
    // The centre of the brightest percent of the sphere's pixels.
    struct Lit {
      int brightness, x, y;
    };
    std::vector<Lit> pixels;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 400; ++x) {
        if (picture->depth_m[static_cast<std::size_t>(y * 400 + x)] < kNoDepth)
          pixels.push_back({brightness(picture->image.at(x, y)), x, y});
      }
    }
    std::stable_sort(pixels.begin(), pixels.end(), [](const Lit& a, const Lit& b) { return a.brightness > b.brightness; });
    pixels.resize(pixels.size() / 100);
    Eigen::Vector2f center{0, 0};
    for (const Lit& lit : pixels)
      center += Eigen::Vector2f{static_cast<float>(lit.x) - 199.5F, 149.5F - static_cast<float>(lit.y)};
    center /= static_cast<float>(pixels.size());
    // Light comes from 45 degrees: the diffuse part peaks at 0.71 of the radius of 100 pixels, the glint half way, at 0.38.
    EXPECT_GT(center.norm(), 30.0F);
    EXPECT_LT(center.norm(), 75.0F);
    EXPECT_GT(center.normalized().dot(side), 0.98F);
  }
}

TEST(ScenePicture, deepBloodIsDarkerThanAThinLayer) {
  std::vector<float> thin = layer(30, 0.002);
  std::vector<float> deep;
  for (int level = 0; level < 6; ++level) {
    for (std::size_t i = 0; i < thin.size(); i += 3)
      deep.insert(deep.end(), {thin[i], thin[i + 1], thin[i + 2] + static_cast<float>(level) * 0.004F});
  }
  SceneStyle style = plain();
  style.look = BloodLook::liquid;
  const auto center_of = [&style](const std::vector<float>& positions) {
    const auto picture = drawScene({.positions = positions, .radius_m = 0.002}, {PlaneShape{}}, fromTop(), style);
    return picture->image.at(200, 150);
  };
  EXPECT_TRUE(isRed(center_of(thin)));
  EXPECT_TRUE(isRed(center_of(deep)));
  EXPECT_LT(brightness(center_of(deep)) + 20, brightness(center_of(thin)));
}

TEST(ScenePicture, liquidIsSmootherThanItsSpheres) {
  const std::vector<float> positions = layer(30, 0.002);
  const auto roughness = [&positions](BloodLook look) {
    SceneStyle style = plain();
    style.look = look;
    const auto picture = drawScene({.positions = positions, .radius_m = 0.002}, {PlaneShape{}}, fromTop(), style);
    double sum = 0.0;
    for (int x = 170; x < 230; ++x)
      sum += std::abs(brightness(picture->image.at(x, 150)) - brightness(picture->image.at(x + 1, 150)));
    return sum / 60.0;
  };
  EXPECT_LT(roughness(BloodLook::liquid), 0.2 * roughness(BloodLook::spheres));
}

TEST(ScenePicture, valuesAreColoursOfTheMap) {
  const std::vector<float> positions{-0.05F, 0, 0, 0.05F, 0, 0, 0, 0.05F, 0};
  const std::vector<float> values{0.0F, 10.0F, kNan};
  const Result<ScenePicture> picture =
      drawScene({.positions = positions, .radius_m = 0.02, .values = values}, {}, fromTop(), plain());
  ASSERT_TRUE(picture.ok());
  const Color low = picture->image.at(150, 155);
  const Color high = picture->image.at(250, 155);
  const Color none = picture->image.at(200, 105);
  EXPECT_GT(low.b, low.g) << "the dark end is violet";
  EXPECT_GT(high.g, 2 * high.b) << "the bright end is yellow";
  EXPECT_NEAR(none.r, none.g, 2) << "NaN is grey";
  EXPECT_NEAR(none.g, none.b, 2);

  SceneStyle style = plain();
  style.values = Range{-100.0, 0.0};
  const Result<ScenePicture> given =
      drawScene({.positions = positions, .radius_m = 0.02, .values = values}, {}, fromTop(), style);
  ASSERT_TRUE(given.ok());
  EXPECT_EQ(given->image.at(150, 155), high) << "0 is the upper end of the range that was given";
}

TEST(ScenePicture, samplesSoftenEdges) {
  const std::vector<float> position{0, 0, 0};
  const auto colors = [&position](int samples) {
    SceneStyle style = plain();
    style.samples = samples;
    style.light.key = 0.0F;  // the sphere is nearly of one colour then
    const auto picture = drawScene({.positions = position, .radius_m = 0.05}, {}, fromTop(), style);
    const int inside = brightness(picture->image.at(200, 150));
    const int outside = brightness(picture->image.at(300, 150));
    int between = 0;
    for (int x = 220; x < 280; ++x) {
      for (int y = 100; y < 200; ++y) {
        const int one = brightness(picture->image.at(x, y));
        between += one > inside + 100 && one < outside - 100 ? 1 : 0;
      }
    }
    return between;
  };
  EXPECT_EQ(colors(1), 0);
  EXPECT_GT(colors(3), 30);
}

TEST(ScenePicture, sameInputGivesSameBytes) {
  const std::vector<float> positions = layer(12, 0.004);
  for (const BloodLook look : {BloodLook::spheres, BloodLook::liquid}) {
    SceneStyle style;
    style.width = 320, style.height = 240;
    style.look = look;
    style.caption = "the same";
    const auto first = drawScene({.positions = positions, .radius_m = 0.004}, {PlaneShape{}}, fromTop(), style);
    const auto second = drawScene({.positions = positions, .radius_m = 0.004}, {PlaneShape{}}, fromTop(), style);
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_EQ(first->image, second->image);
    EXPECT_EQ(first->depth_m, second->depth_m);
  }
}

TEST(ScenePicture, badPositionsAreCountedAndOthersStay) {
  const std::vector<float> bad{0, 0, 0, kNan, 0, 0, 0, 0, std::numeric_limits<float>::infinity()};
  const std::vector<float> good{0, 0, 0};
  for (const BloodLook look : {BloodLook::spheres, BloodLook::liquid}) {
    SceneStyle style = plain();
    style.look = look;
    const auto with = drawScene({.positions = bad, .radius_m = 0.02}, {PlaneShape{}}, fromTop(), style);
    const auto without = drawScene({.positions = good, .radius_m = 0.02}, {PlaneShape{}}, fromTop(), style);
    ASSERT_TRUE(with.ok() && without.ok());
    EXPECT_EQ(with->counts.not_finite, 2U);
    EXPECT_EQ(with->counts.drawn, 1U);
    EXPECT_EQ(with->image, without->image);
  }
}

TEST(ScenePicture, emptySceneIsBackground) {
  for (const BloodLook look : {BloodLook::spheres, BloodLook::liquid}) {
    SceneStyle style = plain();
    style.look = look;
    const auto picture = drawScene({}, {}, fromTop(), style);
    ASSERT_TRUE(picture.ok()) << picture.status().message();
    EXPECT_EQ(picture->counts.drawn, 0U);
    EXPECT_GT(brightness(picture->image.at(200, 150)), 500);
  }
}

TEST(ScenePicture, refusesBadInputByName) {
  const std::vector<float> position{0, 0, 0};
  const ParticleCloud cloud{.positions = position, .radius_m = 0.01};
  const auto refused = [&](const SceneStyle& style) { return drawScene(cloud, {}, fromTop(), style).status().message(); };
  SceneStyle style = plain();
  style.width = 0;
  EXPECT_THAT(refused(style), HasSubstr("0 x 300"));
  style = plain();
  style.width = Image::kMostSide + 1;
  EXPECT_THAT(refused(style), HasSubstr("16384"));
  style = plain();
  style.width = 8000, style.height = 8000, style.samples = 2;
  EXPECT_THAT(refused(style), HasSubstr("fewer samples"));
  style = plain();
  style.samples = 5;
  EXPECT_THAT(refused(style), HasSubstr("samples is 5"));
  style = plain();
  style.values = Range{1.0, 1.0};
  EXPECT_THAT(refused(style), HasSubstr("range of the colours"));
  style = plain();
  style.light.towards = {0, 0, 0};
  EXPECT_THAT(refused(style), HasSubstr("light"));
  EXPECT_THAT(drawScene({.positions = position}, {}, fromTop(), plain()).status().message(), HasSubstr("radius"));
  EXPECT_THAT(drawScene(cloud, {PlaneShape{{0, 0, 0}, {0, 0, 0}}}, fromTop(), plain()).status().message(), HasSubstr("normal"));
  Camera camera = fromTop();
  camera.target = camera.eye;
  EXPECT_THAT(drawScene(cloud, {}, camera, plain()).status().message(), HasSubstr("same point"));
}

}  // namespace
}  // namespace bleedsim::picture::test
