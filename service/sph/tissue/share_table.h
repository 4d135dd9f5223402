// What a wall behind a plane (or a sphere) adds to a particle at distance d, made from the layers of the rest lattice that would
// stand there: design document walls.md, "Build this (E)". Layer l >= 0 lies at depth (l + 1/2) dx and is averaged over its
// lateral offsets, so that it is a plane with the volume V/dx^2 = m/(rho0 dx^2) per area.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "service/sph/radius_nodes.h"
#include "service/sph/smoothing_kernel.h"

namespace bleedsim::sph {

/// The lattice that blood at rest is measured against.
struct ShareSettings {
  SmoothingKernel kernel;
  double spacing = 0.0;                      ///< dx, m
  double particle_mass = 0.0;                ///< kg, calibrated (rest_lattice.h)
  double rest_density = 0.0;                 ///< kg/m^3
  RadiusBounds radii{};                      ///< of particles' own support radii, over kernel.h
  bool calibrates_radii = true;              ///< the mass is calibrated at every radius, not at h alone
  std::optional<double> softening_radius{};  ///< whose 0.01 h^2 softens the friction, m; without it kernel.h
};

template <class Real>
struct Share {
  Real share = 0;           ///< L: the wall's part of the density is rho0 L
  Real slope = 0;           ///< G = dL/dd, 1/m, <= 0
  Real friction = 0;        ///< F0 = sum V f, 1/m^2, <= 0; f(r) = 2 r W'/(r^2 + 0.01 h^2)
  Real friction_depth = 0;  ///< F1 = sum V f depth, 1/m, <= 0
};

/// L, G, F0 and F1 on d in [-h, h], 800 nodes, linear between them; the end values beyond.
template <class Real>
class ShareTable {
 public:
  static constexpr int kNodes = 800;

  /// `curvature` is 1/R, 1/m: > 0 for blood inside a sphere, < 0 for blood around one, 0 for a plane. A curved wall scales all
  /// four by curvedRatio().
  ShareTable(const ShareSettings& settings, double curvature);

  Share<Real> at(Real d) const {
    const Real position = std::min(std::max(Real{0}, (d + reach_) * nodes_per_metre_), Real{kNodes - 1});
    const int index = std::min(static_cast<int>(position), kNodes - 2);
    const Real t = position - static_cast<Real>(index);
    const Share<Real>& a = nodes_[static_cast<std::size_t>(index)];
    const Share<Real>& b = nodes_[static_cast<std::size_t>(index) + 1];
    return {a.share + t * (b.share - a.share), a.slope + t * (b.slope - a.slope), a.friction + t * (b.friction - a.friction),
            a.friction_depth + t * (b.friction_depth - a.friction_depth)};
  }

  /// L at d = -h, the share of a particle that only sees wall: near 1, the mass calibration apart.
  Real full() const { return nodes_.front().share; }

 private:
  Real reach_ = 0;
  Real nodes_per_metre_ = 0;
  std::vector<Share<Real>> nodes_;
};

/// ShareTable for particles with support radii of their own (34): one at each of the radius' nodes, linear between. A single
/// table where radii do not vary.
template <class Real>
class ShareTables {
 public:
  ShareTables(const ShareSettings& settings, double curvature);

  Share<Real> at(Real d, const RadiusPlace<Real>& own = {}) const {
    if (tables_.size() == 1) return tables_[0].at(d);
    const Share<Real> a = tables_[own.node].at(d);
    if (own.part == Real(0)) return a;
    const Share<Real> b = tables_[own.node + 1].at(d);
    return {a.share + own.part * (b.share - a.share), a.slope + own.part * (b.slope - a.slope),
            a.friction + own.part * (b.friction - a.friction),
            a.friction_depth + own.part * (b.friction_depth - a.friction_depth)};
  }
  Real full(const RadiusPlace<Real>& own = {}) const {
    if (tables_.size() == 1) return tables_[0].full();
    return tables_[own.node].full() + own.part * (tables_[own.node + 1].full() - tables_[own.node].full());
  }

 private:
  std::vector<ShareTable<Real>> tables_;
};

/// The same four numbers straight from their sums over a plane's layers, in double precision.
Share<double> planeShare(const ShareSettings& settings, double d);

/// int W over the wall behind a sphere, divided by that behind its tangent plane, clamped to 0.5..2.
double curvedRatio(const SmoothingKernel& kernel, double curvature, double d);

extern template class ShareTables<float>;
extern template class ShareTables<double>;
extern template class ShareTable<float>;
extern template class ShareTable<double>;

}  // namespace bleedsim::sph
