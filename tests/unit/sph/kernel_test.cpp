// The kernels' closed forms in space and in the plane: norms, derivatives, Laplacians, and what the paper claims of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <tuple>

#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {
namespace {

constexpr double kH = 0.0025;

/// Composite Gauss-Legendre with two points a panel: exact for cubics, never at an end, where some kernels have no value.
template <class Function>
double integrate(double from, double to, const Function& function) {
  constexpr int kPanels = 4000;
  const double half = 0.5 * (to - from) / kPanels;
  const double offset = half / std::sqrt(3.0);
  double sum = 0.0;
  for (int k = 0; k < kPanels; ++k) {
    const double middle = from + (2 * k + 1) * half;
    sum += function(middle - offset) + function(middle + offset);
  }
  return sum * half;
}

using Case = std::tuple<KernelType, bool>;

class KernelTest : public testing::TestWithParam<Case> {
 protected:
  KernelType type_ = std::get<0>(GetParam());
  bool planar_ = std::get<1>(GetParam());
  SmoothingKernel kernel_{type_, kH, planar_ ? 0.001 : 0.0};
  double dimension_ = planar_ ? 2.0 : 3.0;

  /// Of a shell of radius r over dr, m^2.
  double shell(double r) const { return planar_ ? 2.0 * std::numbers::pi * r * kernel_.layer : 4.0 * std::numbers::pi * r * r; }
};

// int W dV = 1. The quadrature's error is below 1e-9 where W is smooth; r ln r at the middle of (32) in the plane costs 1e-8.
TEST_P(KernelTest, integratesToOne) {
  EXPECT_NEAR(integrate(0.0, kH, [&](double r) { return shell(r) * kernel_.value(r); }), 1.0, 1e-6);
}

// int W dV = -1/d int r W' dV and int r^2 lap W dV = 2 d int W dV, because W and W' vanish at the support's edge.
TEST_P(KernelTest, momentsOfSlopeAndLaplacianAreThoseOfTheKernel) {
  EXPECT_NEAR(integrate(0.0, kH, [&](double r) { return shell(r) * r * kernel_.slope(r); }), -dimension_, 1e-6 * dimension_);
  EXPECT_NEAR(integrate(0.0, kH, [&](double r) { return shell(r) * r * r * kernel_.laplacian(r); }), 2.0 * dimension_,
              1e-6 * 2.0 * dimension_);
}

// Central differences: the error is the step's square, (1e-5)^2 of the third derivative's scale, plus rounding 1e-16/1e-5.
TEST_P(KernelTest, slopeAndLaplacianAreDerivatives) {
  const double step = 1e-5 * kH;
  for (double q = 0.11; q < 0.99; q += 0.07) {
    const double r = q * kH;
    const double slope = (kernel_.value(r + step) - kernel_.value(r - step)) / (2.0 * step);
    EXPECT_NEAR(kernel_.slope(r), slope, 1e-6 * std::abs(kernel_.slope(0.5 * kH))) << q;
    const auto flux = [&](double at) { return std::pow(at, dimension_ - 1.0) * kernel_.slope(at); };
    const double laplacian = (flux(r + step) - flux(r - step)) / (2.0 * step) / std::pow(r, dimension_ - 1.0);
    EXPECT_NEAR(kernel_.laplacian(r), laplacian, 1e-6 * std::abs(kernel_.slope(0.5 * kH)) / kH) << q;
  }
}

// (31) as printed is positive. All kernels fall with distance, so that pressure pushes particles apart.
TEST_P(KernelTest, fallsWithDistanceAndEndsAtTheSupport) {
  for (double q = 0.01; q < 1.0; q += 0.03) {
    EXPECT_LT(kernel_.slope(q * kH), 0.0) << q;
    EXPECT_GT(kernel_.value(q * kH), 0.0) << q;
  }
  for (const double q : {1.0, 1.5}) {
    EXPECT_EQ(kernel_.value(q * kH), 0.0);
    EXPECT_EQ(kernel_.slope(q * kH), 0.0);
    EXPECT_EQ(kernel_.laplacian(q * kH), 0.0);
  }
}

std::string nameOf(const testing::TestParamInfo<Case>& tested) {
  constexpr std::array<const char*, 5> kNames{"WendlandC2", "CubicSpline", "Poly6", "Spiky", "Viscosity"};
  return std::string{kNames[static_cast<std::size_t>(std::get<0>(tested.param))]} +
         (std::get<1>(tested.param) ? "InThePlane" : "InSpace");
}

INSTANTIATE_TEST_SUITE_P(All, KernelTest,
                         testing::Combine(testing::Values(KernelType::wendland_c2, KernelType::cubic_spline, KernelType::poly6,
                                                          KernelType::spiky, KernelType::viscosity),
                                          testing::Bool()),
                         nameOf);

// The paper's own forms in space. Equal to rounding.
TEST(PaperKernel, isThePrintedForm) {
  const double h2 = kH * kH;
  const double h3 = h2 * kH;
  const double h6 = h3 * h3;
  const double pi = std::numbers::pi;
  for (double q = 0.05; q < 1.0; q += 0.1) {
    const double r = q * kH;
    const auto expect = [&](double value, double printed) { EXPECT_NEAR(value / printed, 1.0, 1e-12) << q; };
    expect(SmoothingKernel{KernelType::poly6, kH}.value(r), 315.0 / (64.0 * pi * h6 * h3) * std::pow(h2 - r * r, 3));
    expect(SmoothingKernel{KernelType::poly6, kH}.slope(r), -945.0 / (32.0 * pi * h6 * h3) * r * std::pow(h2 - r * r, 2));
    expect(SmoothingKernel{KernelType::poly6, kH}.laplacian(r),
           -945.0 / (32.0 * pi * h6 * h3) * (h2 - r * r) * (3.0 * h2 - 7.0 * r * r));
    expect(SmoothingKernel{KernelType::spiky, kH}.value(r), 15.0 / (pi * h6) * std::pow(kH - r, 3));
    expect(SmoothingKernel{KernelType::spiky, kH}.slope(r), -45.0 / (pi * h6) * std::pow(kH - r, 2));
    expect(SmoothingKernel{KernelType::viscosity, kH}.value(r),
           15.0 / (2.0 * pi * h3) * (-r * r * r / (2.0 * h3) + r * r / h2 + kH / (2.0 * r) - 1.0));
    expect(SmoothingKernel{KernelType::spiky, kH}.laplacian(r), 90.0 / (pi * h6) * (kH - r) * (2.0 - kH / r));
    expect(SmoothingKernel{KernelType::viscosity, kH}.slope(r),
           15.0 / (2.0 * pi * h3) * (-3.0 * r * r / (2.0 * h3) + 2.0 * r / h2 - kH / (2.0 * r * r)));
    expect(SmoothingKernel{KernelType::viscosity, kH}.laplacian(r), 45.0 / (pi * h6) * (kH - r));
    expect(SmoothingKernel{KernelType::viscosity, kH, 0.001}.laplacian(r), 40.0 / (pi * h2 * h3) * (kH - r) / 0.001);
  }
}

// The design's forms (physics.md section 2) in space, with the Laplacians W'' + 2 W'/r that follow. Equal to rounding; q = 0.05
// to 0.95 without 1/2, where both Laplacians pass through 0.
TEST(SoundKernel, isTheDesignsForm) {
  const double h3 = kH * kH * kH;
  const double pi = std::numbers::pi;
  const SmoothingKernel wendland{KernelType::wendland_c2, kH};
  const SmoothingKernel spline{KernelType::cubic_spline, kH};
  for (double q = 0.05; q < 1.0; q += 0.1) {
    const double r = q * kH;
    const double t = 1.0 - q;
    const bool inner = q < 0.5;
    const auto expect = [&](double value, double form) { EXPECT_NEAR(value / form, 1.0, 1e-12) << q; };
    expect(wendland.value(r), 21.0 / (2.0 * pi * h3) * t * t * t * t * (1.0 + 4.0 * q));
    expect(wendland.slope(r), -210.0 / (pi * h3 * kH) * q * t * t * t);
    expect(wendland.laplacian(r), -630.0 / (pi * h3 * kH * kH) * t * t * (1.0 - 2.0 * q));
    expect(spline.value(r), 8.0 / (pi * h3) * (inner ? 1.0 - 6.0 * q * q + 6.0 * q * q * q : 2.0 * t * t * t));
    expect(spline.slope(r), 8.0 / (pi * h3 * kH) * (inner ? -12.0 * q + 18.0 * q * q : -6.0 * t * t));
    expect(spline.laplacian(r), 8.0 / (pi * h3 * kH * kH) * (inner ? -36.0 + 72.0 * q : 12.0 * t * (2.0 * q - 1.0) / q));
  }
}

// The claim behind (32): viscosity from poly6's or spiky's Laplacian would speed particles up somewhere, (33) nowhere.
TEST(PaperKernel, laplaciansOfPoly6AndSpikyAreNegativeInARangeThatOfViscosityNowhere) {
  const auto lowest = [](KernelType type) {
    double least = 1e300;
    for (double q = 0.01; q < 1.0; q += 0.01) least = std::min(least, SmoothingKernel{type, kH}.laplacian(q * kH));
    return least;
  };
  EXPECT_LT(lowest(KernelType::poly6), 0.0);
  EXPECT_LT(lowest(KernelType::spiky), 0.0);
  EXPECT_GT(lowest(KernelType::viscosity), 0.0);
}

// The claim behind (30): poly6's slope vanishes between particles that come close, so nothing parts them; spiky's grows.
TEST(PaperKernel, slopeOfPoly6VanishesInTheMiddleThatOfSpikyIsSteepestThere) {
  const SmoothingKernel poly6{KernelType::poly6, kH};
  const SmoothingKernel spiky{KernelType::spiky, kH};
  EXPECT_LT(std::abs(poly6.slope(0.01 * kH)), 0.05 * std::abs(poly6.slope(0.4 * kH)));
  EXPECT_GT(std::abs(spiky.slope(0.01 * kH)), 2.0 * std::abs(spiky.slope(0.4 * kH)));
}

TEST(KernelNorms, areThoseOfThePassesGradients) {
  for (const bool planar : {false, true}) {
    for (const double q : {0.2, 0.45, 0.7}) {
      const double r = q * kH;
      const double t = 1.0 - q;
      const double layer = planar ? kH : 0.0;  // so that 1/h^d = 1/h^3
      const double unit = std::numbers::pi * kH * kH * kH * kH;
      const auto gradient_of = [&](KernelType type) { return -SmoothingKernel{type, kH, layer}.slope(r) * unit / q; };
      EXPECT_NEAR(gradient_of(KernelType::wendland_c2), kernelNorms(KernelType::wendland_c2, planar).gradient * t * t * t, 1e-9);
      EXPECT_NEAR(gradient_of(KernelType::spiky), kernelNorms(KernelType::spiky, planar).gradient * t * t / q, 1e-9);
      EXPECT_NEAR(gradient_of(KernelType::cubic_spline),
                  kernelNorms(KernelType::cubic_spline, planar).gradient * (q < 0.5 ? 2.0 - 3.0 * q : t * t / q), 1e-9);
    }
  }
}

}  // namespace
}  // namespace bleedsim::sph
