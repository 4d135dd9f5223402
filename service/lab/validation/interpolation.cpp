// Case 1: kernels by themselves. The pair passes evaluate the same functions (smoothing_kernel.h).
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "service/lab/validation/cases.h"
#include "service/sph/smoothing_kernel.h"

namespace bleedsim::lab {
namespace {

using sph::KernelType;
using sph::SmoothingKernel;
using sph::Vec3;

struct Named {
  KernelType type;
  const char* name;
};
constexpr std::array kKernels{Named{KernelType::wendland_c2, "wendland"}, Named{KernelType::cubic_spline, "spline"},
                              Named{KernelType::poly6, "poly6"}, Named{KernelType::spiky, "spiky"},
                              Named{KernelType::viscosity, "viscosity"}};

/// |integral of W over space - 1|, by the midpoint rule.
double momentError(const SmoothingKernel& kernel) {
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double r = (k + 0.5) / kSteps;
    sum += 4.0 * std::numbers::pi * r * r * kernel.value(r) / kSteps;
  }
  return std::abs(sum - 1.0);
}

/// The largest dW/dr, over that of its magnitude: not above 0.
double worstSlope(const SmoothingKernel& kernel) {
  double largest = -1e300;
  double scale = 0.0;
  for (int k = 1; k < 1000; ++k) {
    largest = std::max(largest, kernel.slope(1e-3 * k));
    scale = std::max(scale, std::abs(kernel.slope(1e-3 * k)));
  }
  return std::max(0.0, largest) / scale;
}

/// Largest |sum V_j f_j W_ij - f_i| of f = sin(2 pi x) with `per_wave` particles along a wave, at points between the lattice's.
double interpolationError(KernelType type, double per_wave, double support_ratio) {
  constexpr int kPoints = 16;
  const double dx = 1.0 / per_wave;
  const SmoothingKernel kernel{type, support_ratio * dx};
  const int reach = static_cast<int>(std::ceil(support_ratio)) + 1;
  const auto field = [](double x) { return std::sin(2.0 * std::numbers::pi * x); };
  double worst = 0.0;
  for (int point = 0; point < kPoints; ++point) {
    // Cell and place in it go through the wave by the golden ratio, so that no point is special.
    const double part = std::fmod(0.618034 * point, 1.0);
    const double cell = std::floor(part * per_wave);
    const Vec3 at = dx * Vec3{cell + part, std::fmod(7.0 * part, 1.0), std::fmod(13.0 * part, 1.0)};
    double sum = 0.0;
    for (int z = -reach; z <= reach; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const Vec3 node = dx * Vec3{cell + x, double(y), double(z)};
          sum += dx * dx * dx * field(node.x()) * kernel.value((at - node).norm());
        }
      }
    }
    worst = std::max(worst, std::abs(sum - field(at.x())));
  }
  return worst;
}

}  // namespace

// Order: h/dx grows like the square root of the refinement, from the knobs' at 10 particles a wave on, so h shrinks like
// dx^(1/2); the error of the smoothing is h^2, that of the sums over a lattice falls with h/dx.
Result<CaseResult> runInterpolation(const Knobs& knobs) {
  CaseResult result;
  for (const Named& named : kKernels) {
    const SmoothingKernel kernel{named.type, 1.0};
    result.figures.push_back(residual(fmt::format("moment_{}", named.name), momentError(kernel), 1e-6));
    result.figures.push_back(residual(fmt::format("rising_slope_{}", named.name), worstSlope(kernel), 1e-6));
  }
  picture::Series grows{"h/dx grows with refinement", picture::SeriesStyle::line_with_points, {}, {}};
  std::array<double, 3> error{};
  std::array<double, 3> reach{};
  const double start = std::max(3.5, knobs.support_ratio);  // below it the lattice's error hides that of the smoothing
  for (std::size_t level = 0; level < 3; ++level) {
    const double per_wave = knobs.across * std::pow(2.0, static_cast<double>(level));
    const double ratio = start * std::pow(2.0, 0.5 * static_cast<double>(level));
    error[level] = interpolationError(KernelType::wendland_c2, per_wave, ratio);
    reach[level] = ratio / per_wave;
    grows.x.push_back(reach[level]);
    grows.y.push_back(error[level]);
  }
  const double order = std::log(error[0] / error[2]) / std::log(reach[0] / reach[2]);
  Figure figure{"order", order, 2.0, std::max(0.0, 2.0 - order), 0.2, {}};
  result.figures.push_back(figure);
  picture::LinePlot plot;
  plot.title = "Interpolation of a sine wave";
  plot.x = {"h over wavelength", true, {}, {}};
  plot.y = {"largest error", true, {}, {}};
  plot.series = {grows};
  for (const double ratio : {2.0, 2.5, 3.0}) {
    picture::Series fixed{fmt::format("h = {} dx", ratio), picture::SeriesStyle::line_with_points, {}, {}};
    for (const double per_wave : {10.0, 20.0, 40.0, 80.0, 160.0}) {
      fixed.x.push_back(ratio / per_wave);
      fixed.y.push_back(interpolationError(KernelType::wendland_c2, per_wave, ratio));
    }
    result.figures.push_back(residual(fmt::format("floor_h_{}_dx", ratio == 2.5 ? "2_5" : fmt::format("{:.0f}", ratio)),
                                      fixed.y.back(), std::nullopt));
    plot.series.push_back(fixed);
  }
  result.plots.push_back({"interpolation", plot});
  return result;
}

}  // namespace bleedsim::lab
