// The liquid's smoothing and the darkening of creases, on surfaces that are known.
#include "service/picture/smooth_surface.h"

#include <cmath>
#include <gtest/gtest.h>

#include "service/picture/occlusion.h"

namespace bleedsim::picture::test {
namespace {

constexpr double kPixel = 1e-3;  // m
constexpr int kSide = 120;

/// Orthographic, 1 mm a pixel.
View viewOf() {
  Camera camera;
  camera.projection = Camera::Projection::orthographic;
  camera.eye = {0, 0, 1};
  camera.up = Vec3::UnitY();
  camera.width_m = kSide * kPixel;
  return *View::create(camera, kSide, kSide);
}

template <class Depth>
Surface surfaceOf(const Depth& depth) {
  Surface surface{kSide, kSide};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) surface.depth[surface.index(x, y)] = static_cast<float>(depth(x, y));
  }
  return surface;
}

/// The greatest distance from `depth` in the middle of the picture.
template <class Depth>
double worst(const Surface& surface, const Depth& depth) {
  double most = 0.0;
  for (int y = 30; y < 90; ++y) {
    for (int x = 30; x < 90; ++x) {
      most = std::max(most, std::abs(static_cast<double>(surface.depth[surface.index(x, y)]) - depth(x, y)));
    }
  }
  return most;
}

const SmoothSettings kSettings{4.0 * kPixel, 5.0 * kPixel, 3};

TEST(SmoothSurface, bumpsVanishAndTheSlopeStays) {
  // Bumps of 8 pixels: a Gauss bell of sigma 4 damps them by exp(-(2 pi 4/8)^2 / 2) = 0.7 %, in three rounds to nothing.
  const auto plane = [](int x, int y) { return 1.0 + 0.2e-3 * x - 0.1e-3 * y; };
  const auto bumpy = [&plane](int x, int y) { return plane(x, y) + 1e-3 * std::sin(x * M_PI / 4.0) * std::sin(y * M_PI / 4.0); };
  Surface surface = surfaceOf(bumpy);
  ASSERT_GT(worst(surface, plane), 0.9e-3);
  smoothSurface(viewOf(), kSettings, surface);
  EXPECT_LT(worst(surface, plane), 0.02e-3);
  // z grows with x and falls with y, which runs down: the normal towards the camera is (0.2, 0.1, -1) but for its length.
  const Eigen::Vector3f normal = Eigen::Vector3f{0.2F, 0.1F, -1.0F}.normalized();
  EXPECT_LT((surface.normal[surface.index(60, 60)] - normal).norm(), 0.02F);
}

TEST(SmoothSurface, stepsBeyondTheRangeStaySharp) {
  const auto step = [](int x, int) { return x < 60 ? 1.0 : 1.1; };
  Surface surface = surfaceOf(step);
  smoothSurface(viewOf(), kSettings, surface);
  // The nearer side counts the farther one as lying at the end of the range, 5 mm away. Less than half of the weight is on that
  // side, so a round moves it by less than 2.5 mm.
  EXPECT_NEAR(static_cast<double>(surface.depth[surface.index(60, 60)]), 1.1, 1e-6);
  EXPECT_NEAR(static_cast<double>(surface.depth[surface.index(59, 60)]), 1.0, 3 * 2.5e-3);
}

TEST(SmoothSurface, nothingStaysNothing) {
  Surface surface{kSide, kSide};
  surface.depth[surface.index(60, 60)] = 1.0F;
  surface.normal[surface.index(60, 60)] = {0, 0, -1};
  smoothSurface(viewOf(), kSettings, surface);
  EXPECT_EQ(surface.depth[surface.index(60, 60)], 1.0F);
  EXPECT_EQ(surface.normal[surface.index(60, 60)], (Eigen::Vector3f{0, 0, -1})) << "alone, it keeps its normal";
  EXPECT_FALSE(surface.has(surface.index(61, 60)));
}

TEST(SmoothSurface, quantityIsAMeanOfItsNeighbours) {
  const Surface surface = surfaceOf([](int, int) { return 1.0; });
  std::vector<float> quantity(surface.depth.size(), 2.0F);
  for (int x = 0; x < kSide; x += 2) {
    for (int y = 0; y < kSide; ++y) quantity[surface.index(x, y)] = 4.0F;
  }
  quantity[surface.index(60, 60)] = std::nanf("");
  smoothQuantity(viewOf(), 4.0 * kPixel, surface, quantity);
  // The bell ends after two sigma, where its weight is still 0.14 of the middle: a last column more of one kind is 1 % of the
  // sum.
  EXPECT_NEAR(quantity[surface.index(65, 61)], 3.0F, 0.02F);
  EXPECT_TRUE(std::isnan(quantity[surface.index(60, 60)]));
}

TEST(Occlusion, darkensCreasesButNoSlopesAndNoRidges) {
  const auto occlusion_at = [](const auto& depth, int x) {
    const Surface surface = surfaceOf(depth);
    return occlusionOf(surface.depth, kSide, kSide, 4.0 * kPixel, 8.0)[surface.index(x, 60)];
  };
  EXPECT_NEAR(occlusion_at([](int x, int y) { return 1.0 + 0.5e-3 * x + 0.3e-3 * y; }, 60), 0.0F, 1e-3F) << "a slanted plane";
  EXPECT_GT(occlusion_at([](int x, int) { return 1.0 - 1e-3 * std::abs(x - 60); }, 60), 0.3F) << "a crease";
  EXPECT_EQ(occlusion_at([](int x, int) { return 1.0 + 1e-3 * std::abs(x - 60); }, 60), 0.0F) << "a ridge";
  const auto step = [](double height) { return [height](int x, int) { return x < 60 ? 1.0 - height : 1.0; }; };
  EXPECT_GT(occlusion_at(step(0.01), 61), 0.2F) << "beside a low step";
  EXPECT_EQ(occlusion_at(step(0.01), 80), 0.0F) << "far from it";
  EXPECT_EQ(occlusion_at(step(0.5), 61), 0.0F) << "behind something far in front";
}

}  // namespace
}  // namespace bleedsim::picture::test
