// All tissue of a scene as one boundary: share of density, its gradient, friction and contact spring of a particle, by the model
// "E" of the design document walls.md, and the safety net that puts a particle back into the blood.
//
// Container faces are separate planes (their edges are concave). Convex edges, of a block and of a bowl's rim, take the part that
// lies behind all their faces at once, by the same rule, from the distances to the unbounded faces; distance, normal and spring
// there come from the one exact signed distance, so that edges are round to the touch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "service/sph/tissue/share_table.h"
#include "service/sph/tissue/signed_distance.h"
#include "service/sph/tissue/wall_combination.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// How the tissue acts on one particle.
template <class Real>
struct WallSample {
  Real distance = 0;               ///< phi of the nearest wall, m; < 0 inside the tissue
  std::array<Real, 3> normal{};    ///< of the nearest wall, unit, into the blood
  Real share = 0;                  ///< L in [0, 1]: the density gains rho0 L
  std::array<Real, 3> gradient{};  ///< grad L, 1/m: pressure adds a_i = -rho0 (p_i/rho_i^2) grad L
  Real friction = 0;               ///< <= 0, 1/m^2, slip included: a_i = (mu/rho_i) friction (v_i - v_wall); mu calibrated
  std::array<Real, 3> spring{};    ///< 1/m: a_i = c0^2 spring
  Real grip = 1;                   ///< 1 - slip of the nearest wall
};

/// All lengths in metres. Immutable; any number of threads may ask at once. No function allocates but create().
template <class Real>
class TissueField {
 public:
  static constexpr std::size_t kMostTissues = 256;

  /// No tissue.
  TissueField() = default;

  /// invalid_argument with the tissue's name, the value and what is allowed.
  static Result<TissueField> create(const std::vector<TissueDescription>& tissue, const ShareSettings& settings);

  bool empty() const { return planes_.empty() && obstacles_.empty() && bowls_.empty(); }

  /// False, and `out` untouched, if no wall is within the largest support radius (a NaN position is within reach of none). Points
  /// inside tissue are. `radius`: the particle's own support radius over h.
  bool sample(Real x, Real y, Real z, WallSample<Real>& out, Real radius = Real(1)) const;

  /// Which walls sample() may find in the box between two corners.
  enum class Nearness {
    none,    ///< sample() is false all over the box
    plane,   ///< one plane at most
    hollow,  ///< at most one bowl, deep under its rim
    any      ///< also where a corner is no number
  };
  struct Nearby {
    Nearness nearness = Nearness::none;
    std::size_t index = 0;  ///< of the one wall
  };
  Nearby nearby(const std::array<Real, 3>& lower, const std::array<Real, 3>& upper) const;

  /// What sample() returns in the box of `near`, which has one wall alone: without a branch.
  template <Nearness kNearness>
  bool touchesLone(const Nearby& near, Real x, Real y, Real z) const;
  /// The numbers that sample() gives there, where touchesLone() is true.
  template <Nearness kNearness>
  void sampleLone(const Nearby& near, Real x, Real y, Real z, WallSample<Real>& out, Real radius = Real(1)) const;

  /// L of a plane at phi = d, without edges and curvature; there must be tissue.
  Real planeShareAt(Real d) const { return plane_table_->at(d).share; }

  /// The smallest phi of all walls, m; infinity without tissue.
  Real distance(Real x, Real y, Real z) const;

  /// Moves a point that lies inside tissue along the normals to kProjectionGap spacings in front of it, and returns true with the
  /// normal of the last wall that moved it; otherwise false. Walls are visited in turn, at most kMostProjections times round,
  /// which ends in front of all of them wherever there is room between them.
  bool project(std::array<Real, 3>& position, std::array<Real, 3>& normal) const;

  static constexpr double kProjectionGap = 1e-3;
  static constexpr int kMostProjections = 16;

 private:
  struct Plane {
    PlaneSurface<Real> surface;
    Real grip;  ///< 1 - slip
  };
  struct Obstacle {
    ObstacleSurface<Real> surface;
    Real grip;
  };
  struct Bowl {
    BowlSurface<Real> surface;
    Real grip;
    ShareTables<Real> table;  ///< of the hollow
  };

  using Own = RadiusPlace<Real>;
  void takeLone(const Share<Real>& share, Real distance, const std::array<Real, 3>& normal, Real grip,
                WallSample<Real>& out) const;
  void addPlane(const Plane& plane, Real distance, const Own& own, WallTerms<Real>& terms) const;
  void addObstacle(const Obstacle& obstacle, Real x, Real y, Real z, const Own& own, WallTerms<Real>& terms) const;
  void addBowl(const Bowl& bowl, Real x, Real y, Real z, const Own& own, WallTerms<Real>& terms) const;
  /// F0 + F1/max(d, dx/4): walls.md's extrapolation of the velocity into the wall.
  Real frictionOf(const Share<Real>& share, Real distance) const;
  /// The friction of a plane at phi in the proportion of the shares: what an edge leaves of it, or a hollow adds.
  Real scaledFriction(Real share, Real distance, const Own& own) const;

  Real reach_ = 0;         ///< the largest support radius, m
  Real spring_reach_ = 0;  ///< dx/2
  Real spring_scale_ = 0;  ///< 1/dx^2
  Real gap_ = 0;
  RadiusScale<Real> radii_;
  std::optional<ShareTables<Real>> plane_table_;  ///< none without tissue
  std::vector<Plane> planes_;
  std::vector<Obstacle> obstacles_;
  std::vector<Bowl> bowls_;
};

template <class Real>
Real TissueField<Real>::frictionOf(const Share<Real>& share, Real distance) const {
  return share.friction + share.friction_depth / std::max(distance, static_cast<Real>(0.5) * spring_reach_);
}

template <class Real>
template <typename TissueField<Real>::Nearness kNearness>
bool TissueField<Real>::touchesLone(const Nearby& near, Real x, Real y, Real z) const {
  if constexpr (kNearness == Nearness::plane) {
    return planes_[near.index].surface.value(x, y, z) < reach_;
  } else {
    static_assert(kNearness == Nearness::hollow);
    return bowls_[near.index].surface.nearsSphere({x, y, z}, {}, reach_);
  }
}

template <class Real>
template <typename TissueField<Real>::Nearness kNearness>
void TissueField<Real>::sampleLone(const Nearby& near, Real x, Real y, Real z, WallSample<Real>& out, Real radius) const {
  const Own own = radii_.at(radius);
  if constexpr (kNearness == Nearness::plane) {
    const Plane& plane = planes_[near.index];
    const Real distance = plane.surface.value(x, y, z);
    takeLone(plane_table_->at(distance, own), distance, plane.surface.normal(), plane.grip, out);
  } else {
    static_assert(kNearness == Nearness::hollow);
    const Bowl& bowl = bowls_[near.index];
    const auto part = bowl.surface.parts(x, y, z);
    takeLone(bowl.table.at(part.sphere, own), part.sphere, part.sphere_normal, bowl.grip, out);
  }
}

template <class Real>
void TissueField<Real>::takeLone(const Share<Real>& share, Real distance, const std::array<Real, 3>& normal, Real grip,
                                 WallSample<Real>& out) const {
  const Real spring = std::max(spring_reach_ - distance, Real{0}) * spring_scale_;
  out.distance = distance;
  out.normal = normal;
  out.share = share.share;
  for (std::size_t a = 0; a < 3; ++a) {
    out.gradient[a] = share.slope * normal[a];
    out.spring[a] = spring * normal[a];
  }
  out.friction = std::min(frictionOf(share, distance) * grip, Real{0});
  out.grip = grip;
}

extern template class TissueField<float>;
extern template class TissueField<double>;

}  // namespace bleedsim::sph
