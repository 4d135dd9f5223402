#include "service/sph/tissue/share_table.h"

#include <array>
#include <cmath>

#include "service/sph/rest_lattice.h"

namespace bleedsim::sph {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Composite Gauss-Legendre, four points a panel.
template <class Function>
double integrate(double from, double to, const Function& function) {
  constexpr std::array<double, 2> kOffset{0.3399810435848563, 0.8611363115940526};
  constexpr std::array<double, 2> kWeight{0.6521451548625461, 0.3478548451374538};
  constexpr int kPanels = 16;
  const double half = 0.5 * (to - from) / kPanels;
  double sum = 0.0;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle = from + (2.0 * panel + 1.0) * half;
    for (std::size_t k = 0; k < kOffset.size(); ++k) {
      sum += kWeight[k] * (function(middle - kOffset[k] * half) + function(middle + kOffset[k] * half));
    }
  }
  return sum * half;
}

/// int W over the ball's part behind the wall. A sphere of radius r about the particle has the fraction (1 - cos)/2 of its area
/// there, where cos = (2 d - k (d^2 + r^2))/(2 (1 - k d) r), which is d/r for a plane (k = 0).
double wallIntegral(const SmoothingKernel& kernel, double curvature, double d) {
  const auto shell = [&](double r) {
    const double across = 2.0 * d - curvature * (d * d + r * r);
    const double along = 2.0 * (1.0 - curvature * d) * r;
    const double cosine = along > 0.0 ? std::clamp(across / along, -1.0, 1.0) : std::copysign(1.0, across);
    return kTwoPi * r * r * kernel.value(r) * (1.0 - cosine);
  };
  const double touching = std::min(std::abs(d), kernel.h);
  return integrate(0.0, touching, shell) + integrate(touching, kernel.h, shell);
}

}  // namespace

Share<double> planeShare(const ShareSettings& settings, double d) {
  const double h = settings.kernel.h;
  const double dx = settings.spacing;
  const double softening_radius = settings.softening_radius.value_or(h);
  const double softening = 0.01 * softening_radius * softening_radius;
  const double volume_per_area = settings.particle_mass / (settings.rest_density * dx * dx);
  Share<double> sum;
  const int first = std::max(0, static_cast<int>(std::floor((-h - d) / dx - 0.5)));
  for (int layer = first;; ++layer) {
    const double depth = (layer + 0.5) * dx;
    const double z = d + depth;
    if (z >= h) break;
    if (z <= -h) continue;
    const double near = std::abs(z);
    const double density = kTwoPi * integrate(near, h, [&](double r) { return settings.kernel.value(r) * r; });
    const double friction =
        kTwoPi * integrate(near, h, [&](double r) { return 2.0 * settings.kernel.slope(r) * r * r / (r * r + softening); });
    sum.share += volume_per_area * density;
    sum.slope -= volume_per_area * kTwoPi * settings.kernel.value(near) * z;
    sum.friction += volume_per_area * friction;
    sum.friction_depth += volume_per_area * friction * depth;
  }
  return sum;
}

double curvedRatio(const SmoothingKernel& kernel, double curvature, double d) {
  if (curvature == 0.0) return 1.0;
  // Both integrals vanish at d = h, their ratio does not; and no point is further from a hollow sphere than its centre.
  double distance = std::clamp(d, -kernel.h, 0.98 * kernel.h);
  if (curvature > 0.0) distance = std::min(distance, 1.0 / curvature);
  return std::clamp(wallIntegral(kernel, curvature, distance) / wallIntegral(kernel, 0.0, distance), 0.5, 2.0);
}

template <class Real>
ShareTable<Real>::ShareTable(const ShareSettings& settings, double curvature)
    : reach_{static_cast<Real>(settings.kernel.h)},
      nodes_per_metre_{static_cast<Real>((kNodes - 1) / (2.0 * settings.kernel.h))},
      nodes_(kNodes) {
  const double h = settings.kernel.h;
  const double step = 2.0 * h / (kNodes - 1);
  for (int node = 0; node < kNodes; ++node) {
    const double d = -h + node * step;
    const Share<double> plane = planeShare(settings, d);
    const double ratio = curvedRatio(settings.kernel, curvature, d);
    const double ratio_slope =
        (curvedRatio(settings.kernel, curvature, d + 0.5 * step) - curvedRatio(settings.kernel, curvature, d - 0.5 * step)) /
        step;
    nodes_[static_cast<std::size_t>(node)] = {
        static_cast<Real>(ratio * plane.share), static_cast<Real>(ratio * plane.slope + ratio_slope * plane.share),
        static_cast<Real>(ratio * plane.friction), static_cast<Real>(ratio * plane.friction_depth)};
  }
}

template <class Real>
ShareTables<Real>::ShareTables(const ShareSettings& settings, double curvature) {
  if (!settings.radii.vary()) {
    tables_.emplace_back(settings, curvature);
    return;
  }
  const double calibrated_at_h = calibrateRestLattice(settings.kernel, settings.spacing, settings.rest_density).particle_mass;
  for (const double radius : radiusNodes(settings.radii)) {
    ShareSettings own = settings;
    own.kernel.h *= radius;
    own.softening_radius = settings.kernel.h;
    if (settings.calibrates_radii) {
      own.particle_mass *= calibrateRestLattice(own.kernel, own.spacing, own.rest_density).particle_mass / calibrated_at_h;
    }
    tables_.emplace_back(own, curvature);
  }
}

template class ShareTables<float>;
template class ShareTables<double>;
template class ShareTable<float>;
template class ShareTable<double>;

}  // namespace bleedsim::sph
