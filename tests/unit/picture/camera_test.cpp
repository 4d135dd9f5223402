// Cameras: where points of the world come to lie in the picture.
#include "service/picture/camera.h"

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace bleedsim::picture::test {
namespace {

using testing::HasSubstr;
using Projection = Camera::Projection;

std::vector<Vec3> cornersOf(const Bounds& bounds) {
  std::vector<Vec3> corners;
  for (const double x : {bounds.lower.x(), bounds.upper.x()}) {
    for (const double y : {bounds.lower.y(), bounds.upper.y()}) {
      for (const double z : {bounds.lower.z(), bounds.upper.z()}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

const Bounds kBox{{-0.02, -0.05, 0.0}, {0.04, 0.01, 0.03}};
constexpr std::array kViews{NamedView::front, NamedView::side, NamedView::top, NamedView::oblique};

TEST(Camera, viewNamesGoBothWays) {
  for (const NamedView view : kViews) {
    const Result<NamedView> parsed = parseView(nameOf(view));
    ASSERT_TRUE(parsed.ok());
    EXPECT_EQ(*parsed, view);
  }
  const Result<NamedView> unknown = parseView("Top");
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.status().message(), HasSubstr("'Top'"));
  EXPECT_THAT(unknown.status().message(), HasSubstr("front, side, top, oblique"));
}

TEST(Camera, fitShowsTheWholeBoxAndFillsThePicture) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    for (const NamedView named : kViews) {
      FitOptions options;
      options.projection = projection;
      options.margin = 0.1;
      const Result<Camera> camera = fitCamera(kBox, named, options);
      ASSERT_TRUE(camera.ok()) << camera.status().message();
      const Result<View> view = View::create(*camera, 800, 600);
      ASSERT_TRUE(view.ok()) << view.status().message();
      double used = 0.0;  // the part of half the picture that the farthest corner reaches
      for (const Vec3& corner : cornersOf(kBox)) {
        const Vec3 at = view->toView(corner);
        ASSERT_GT(at.z(), 0.0);
        const Eigen::Vector2d pixel = view->toPixel(at);
        used = std::max({used, std::abs(pixel.x() - 400.0) / 400.0, std::abs(pixel.y() - 300.0) / 300.0});
      }
      EXPECT_NEAR(used, 0.8, 1e-9) << nameOf(named);
    }
  }
}

TEST(Camera, namedViewsLookTheWayTheirNamesSay) {
  // +x to the right and +z up from the front, +y up from the top; from the side +y to the right.
  const auto pixel_of = [](NamedView named, const Vec3& point) {
    FitOptions options;
    options.projection = Projection::orthographic;
    const View view = *View::create(*fitCamera({{-1, -1, -1}, {1, 1, 1}}, named, options), 800, 600);
    return Eigen::Vector2d{view.toPixel(view.toView(point)) - Eigen::Vector2d{400, 300}};
  };
  EXPECT_GT(pixel_of(NamedView::front, {1, 0, 0}).x(), 100.0);
  EXPECT_LT(pixel_of(NamedView::front, {0, 0, 1}).y(), -100.0);
  EXPECT_GT(pixel_of(NamedView::side, {0, 1, 0}).x(), 100.0);
  EXPECT_LT(pixel_of(NamedView::side, {0, 0, 1}).y(), -100.0);
  EXPECT_GT(pixel_of(NamedView::top, {1, 0, 0}).x(), 100.0);
  EXPECT_LT(pixel_of(NamedView::top, {0, 1, 0}).y(), -100.0);
}

TEST(Camera, orthographicWidthIsInMetres) {
  Camera camera;
  camera.projection = Projection::orthographic;
  camera.width_m = 0.2;
  const View view = *View::create(camera, 400, 300);
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(0.1), 2000.0);
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(5.0), 2000.0);
}

TEST(Camera, pixelsRaysAndViewCoordinatesAgree) {
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    FitOptions options;
    options.projection = projection;
    const View view = *View::create(*fitCamera(kBox, NamedView::oblique, options), 640, 480);
    for (const Vec3& corner : cornersOf(kBox)) {
      const Vec3 at = view.toView(corner);
      const Eigen::Vector2d pixel = view.toPixel(at);
      EXPECT_LT((view.fromPixel(pixel.x(), pixel.y(), at.z()) - at).norm(), 1e-12);
      const Ray ray = view.rayThrough(pixel.x(), pixel.y());
      EXPECT_LT((ray.origin + at.z() * ray.direction - corner).norm(), 1e-12);
    }
  }
}

TEST(Camera, refusesWhatMakesNoView) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const Camera& camera) { return View::create(camera, 800, 600).status().message(); };
  Camera camera;
  camera.eye = camera.target;
  EXPECT_THAT(refused(camera), HasSubstr("same point"));
  camera = {};
  camera.eye = {0, 0, 1};
  EXPECT_THAT(refused(camera), HasSubstr("choose another up"));
  camera = {};
  camera.eye.x() = nan;
  EXPECT_THAT(refused(camera), HasSubstr("finite"));
  camera = {};
  camera.field_of_view_deg = 180.0;
  EXPECT_THAT(refused(camera), HasSubstr("170"));
  camera = {};
  camera.projection = Projection::orthographic;
  camera.width_m = 0.0;
  EXPECT_THAT(refused(camera), HasSubstr("above 0 m"));
  EXPECT_FALSE(View::create(Camera{}, 0, 600).ok());

  EXPECT_FALSE(fitCamera({{0, 0, 0}, {-1, 1, 1}}, NamedView::top).ok());
  EXPECT_FALSE(fitCamera({{0, 0, nan}, {1, 1, 1}}, NamedView::top).ok());
  EXPECT_FALSE(fitCamera(kBox, Vec3::Zero()).ok());
  FitOptions options;
  options.margin = 0.5;
  EXPECT_FALSE(fitCamera(kBox, NamedView::top, options).ok());
}

TEST(Camera, fitsASinglePoint) {
  const Result<Camera> camera = fitCamera({{1, 2, 3}, {1, 2, 3}}, NamedView::front);
  ASSERT_TRUE(camera.ok());
  EXPECT_TRUE(View::create(*camera, 80, 60).ok());
}

TEST(Bounds, leaveOutWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<float> positions{1, 2, 3, nan, 0, 0, -1, 5, 2, 0, infinite, 0};
  const std::optional<Bounds> bounds = boundsOf(positions, 0.5);
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->lower, (Vec3{-1.5, 1.5, 1.5}));
  EXPECT_EQ(bounds->upper, (Vec3{1.5, 5.5, 3.5}));
  EXPECT_FALSE(boundsOf(std::vector<float>{nan, 0, 0}, 0.5));
  EXPECT_FALSE(boundsOf({}, 0.5));
}

}  // namespace
}  // namespace bleedsim::picture::test
