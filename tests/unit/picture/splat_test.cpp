// Spheres in the depth buffer against the geometry of spheres.
#include "service/picture/splat.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace bleedsim::picture::test {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Looks along -z from 1 m above the origin; 1 pixel is 1 mm at the height of the origin in both projections.
View viewOf(Camera::Projection projection, int width = 400, int height = 300) {
  Camera camera;
  camera.projection = projection;
  camera.eye = {0, 0, 1};
  camera.up = Vec3::UnitY();
  camera.width_m = width * 1e-3;
  camera.field_of_view_deg = 2.0 * std::atan(0.5e-3 * width) * 180.0 / std::numbers::pi;
  return *View::create(camera, width, height);
}

std::size_t covered(const Splats& splats) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < splats.surface.depth.size(); ++i) count += splats.surface.has(i) ? 1 : 0;
  return count;
}

TEST(Splat, coversTheAreaOfACircle) {
  // The number of pixel middles in a circle differs from pi r^2 by about sqrt(r) (root mean square over its position). Four times
  // that is 40 of 31 416 pixels here; a radius that is wrong by 0.1 pixel would differ by 63.
  const View view = viewOf(Camera::Projection::orthographic);
  const double r = 100.0;
  for (const float shift : {0.0F, 0.00023F, -0.00041F}) {
    const std::vector<float> position{shift, 0.5F * shift, 0.0F};
    const Splats splats = splatSpheres(view, {.positions = position, .radius_m = r * 1e-3}, {});
    EXPECT_NEAR(static_cast<double>(covered(splats)), std::numbers::pi * r * r, 4.0 * std::sqrt(r));
    EXPECT_EQ(splats.counts.drawn, 1U);
  }
}

TEST(Splat, perspectiveShowsTheTangentCone) {
  // A sphere on the axis at distance d fills the circle of radius f r / sqrt(d^2 - r^2): more than f r / d. Here f is 1000
  // pixels.
  const View view = viewOf(Camera::Projection::perspective);
  const std::vector<float> position{0.0F, 0.0F, 0.5F};
  const double d = 0.5;
  const double r = 0.05;
  const double seen = 1000.0 * r / std::sqrt(d * d - r * r);
  const Splats splats = splatSpheres(view, {.positions = position, .radius_m = r}, {});
  EXPECT_NEAR(static_cast<double>(covered(splats)), std::numbers::pi * seen * seen, 4.0 * std::sqrt(seen));
}

TEST(Splat, everyDepthLiesOnTheSphereAndNormalsPointOutwards) {
  // Off the axis, so that the ellipse of a perspective sphere and its bounding box are tested as well. Depths are float32 of
  // about 1 m: half a unit in the last place is 6e-8 m.
  const std::vector<float> position{0.12F, -0.08F, 0.03F};
  const double r = 0.05;
  for (const auto projection : {Camera::Projection::orthographic, Camera::Projection::perspective}) {
    const View view = viewOf(projection);
    const Splats splats = splatSpheres(view, {.positions = position, .radius_m = r}, {});
    const Vec3 center = view.toView(Eigen::Map<const Eigen::Vector3f>(position.data()).cast<double>());
    std::size_t outside = 0;
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        const std::size_t i = splats.surface.index(x, y);
        const Ray ray = view.rayThrough(x + 0.5, y + 0.5);
        // The distance of the ray from the centre says whether the pixel must be covered.
        const Vec3 world = Eigen::Map<const Eigen::Vector3f>(position.data()).cast<double>() - ray.origin;
        const double miss = world.cross(ray.direction.normalized()).norm();
        if (std::abs(miss - r) > 1e-9) { ASSERT_EQ(splats.surface.has(i), miss < r) << x << ", " << y; }
        if (!splats.surface.has(i)) {
          ++outside;
          continue;
        }
        const Vec3 at = view.fromPixel(x + 0.5, y + 0.5, static_cast<double>(splats.surface.depth[i]));
        // Near the outline the surface runs along the ray and an error of the depth shows less: the bound holds everywhere.
        ASSERT_NEAR((at - center).norm(), r, 1e-6);
        ASSERT_LT((splats.surface.normal[i].cast<double>() - (at - center) / r).norm(), 1e-4);
        const Vec3 along = view.directionToView(ray.direction);
        ASSERT_LT((at - center).dot(along), 1e-6) << "the back of the sphere is seen";
      }
    }
    EXPECT_GT(outside, 0U);
    EXPECT_GT(covered(splats), 7000U);
  }
}

TEST(Splat, nearerSphereHidesTheFartherInAnyOrder) {
  const View view = viewOf(Camera::Projection::orthographic);
  const std::vector<float> far_first{0, 0, 0, 0, 0, 0.2F};
  const std::vector<float> near_first{0, 0, 0.2F, 0, 0, 0};
  const std::size_t middle = splatSpheres(view, {}, {}).surface.index(200, 150);
  EXPECT_EQ(splatSpheres(view, {.positions = far_first, .radius_m = 0.02}, {}).particle[middle], 1U);
  EXPECT_EQ(splatSpheres(view, {.positions = near_first, .radius_m = 0.02}, {}).particle[middle], 0U);
}

TEST(Splat, ofTwoEquallyNearTheFirstIsSeen) {
  const View view = viewOf(Camera::Projection::orthographic);
  const std::vector<float> twice{0, 0, 0, 0, 0, 0};
  const Splats splats = splatSpheres(view, {.positions = twice, .radius_m = 0.02}, {});
  EXPECT_EQ(splats.particle[splats.surface.index(200, 150)], 0U);
}

TEST(Splat, radiiOfTheirOwnReplaceTheCommonOne) {
  const View view = viewOf(Camera::Projection::orthographic);
  const std::vector<float> positions{-0.1F, 0, 0, 0.1F, 0, 0};
  const std::vector<float> radii{0.01F, 0.04F};
  const Splats splats = splatSpheres(view, {.positions = positions, .radius_m = 0.02, .radii = radii}, {});
  const auto seen = [&splats](std::uint32_t particle) {
    return static_cast<double>(std::count(splats.particle.begin(), splats.particle.end(), particle));
  };
  EXPECT_NEAR(seen(0), std::numbers::pi * 100.0, 4.0 * std::sqrt(10.0));
  EXPECT_NEAR(seen(1), std::numbers::pi * 1600.0, 4.0 * std::sqrt(40.0));
}

TEST(Splat, whatCannotBeDrawnIsCountedAndChangesNothing) {
  const View view = viewOf(Camera::Projection::perspective);
  const std::vector<float> good{0, 0, 0};
  //                            good     not finite                       behind    around the eye  beside
  const std::vector<float> all{0, 0, 0, kNan, 0, 0, 0, 0, -kNan, 0, 0, 3, 0, 0, 1.005F, 5, 0, 0};
  const Splats one = splatSpheres(view, {.positions = good, .radius_m = 0.02}, {});
  const Splats splats = splatSpheres(view, {.positions = all, .radius_m = 0.02}, {});
  EXPECT_EQ(splats.counts.drawn, 1U);
  EXPECT_EQ(splats.counts.not_finite, 2U);
  EXPECT_EQ(splats.counts.outside, 3U);
  EXPECT_EQ(splats.surface.depth, one.surface.depth);

  const std::vector<float> radii{0.02F, 0.0F, -1.0F, kNan, std::numeric_limits<float>::infinity()};
  const std::vector<float> five(15, 0.0F);
  EXPECT_EQ(splatSpheres(view, {.positions = five, .radii = radii}, {}).counts.not_finite, 4U);
}

TEST(Splat, thicknessIsTheChordAndAddsUp) {
  const View view = viewOf(Camera::Projection::orthographic);
  const std::vector<float> two{0, 0, 0, 0, 0, 0.3F};
  const double r = 0.05;
  const Splats splats = splatSpheres(view, {.positions = two, .radius_m = r}, {.thickness = true});
  // Through the middle of pixel (200, 150), 0.5 pixels from both axes; at 30 pixels from the middle the chord is shorter.
  const auto chord = [r](double x_px, double y_px) { return 2.0 * std::sqrt(r * r - (x_px * x_px + y_px * y_px) * 1e-6); };
  EXPECT_NEAR(static_cast<double>(splats.thickness[splats.surface.index(200, 150)]), 2.0 * chord(0.5, 0.5), 1e-6);
  EXPECT_NEAR(static_cast<double>(splats.thickness[splats.surface.index(230, 150)]), 2.0 * chord(30.5, 0.5), 1e-6);
  EXPECT_EQ(splats.thickness[splats.surface.index(260, 150)], 0.0F);
}

TEST(Splat, valuesAreMeansByThicknessWithoutTheMissingOnes) {
  const View view = viewOf(Camera::Projection::orthographic);
  const std::vector<float> three{0, 0, 0, 0, 0, 0.3F, 0, 0, 0.6F};
  const std::vector<float> values{1.0F, 3.0F, kNan};
  const Splats splats = splatSpheres(view, {.positions = three, .radius_m = 0.05, .values = values}, {.thickness = true});
  EXPECT_NEAR(splats.value[splats.surface.index(200, 150)], 2.0F, 1e-5F);
  EXPECT_TRUE(std::isnan(splats.value[splats.surface.index(5, 5)]));
}

TEST(Splat, arraysMustFit) {
  const std::vector<float> four(4, 0.0F);
  const std::vector<float> six(6, 0.0F);
  const std::vector<float> three(3, 1.0F);
  EXPECT_THAT(checkCloud({.positions = four, .radius_m = 1.0}).message(), HasSubstr("4 numbers"));
  EXPECT_THAT(checkCloud({.positions = six, .radii = three}).message(), HasSubstr("3 radii for 2 particles"));
  EXPECT_THAT(checkCloud({.positions = six, .radius_m = 1.0, .values = three}).message(), HasSubstr("3 values for 2 particles"));
  EXPECT_THAT(checkCloud({.positions = six, .radius_m = 0.0}).message(), HasSubstr("radius must be above 0"));
  EXPECT_THAT(checkCloud({.positions = six, .radius_m = std::numeric_limits<double>::quiet_NaN()}).message(),
              HasSubstr("radius"));
  EXPECT_TRUE(checkCloud({}).ok());
}

}  // namespace
}  // namespace bleedsim::picture::test
