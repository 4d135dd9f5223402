// All tissue of a scene as one boundary: share of density, its gradient, friction and contact spring of a particle, by the model
// "E" of the design document walls.md, and the safety net that puts a particle back into the blood.
//
// Container faces are separate planes (their edges are concave). Convex edges, of a block and of a bowl's rim, take the part that
// lies behind all their faces at once, by the same rule, from the distances to the unbounded faces; distance, normal and spring
// there come from the one exact signed distance, so that edges are round to the touch.
#pragma once

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

  /// Whether sample() may be true in the box between two corners; false only where it is false all over the box. For one corner
  /// that is no number: true.
  bool mayTouch(const std::array<Real, 3>& lower, const std::array<Real, 3>& upper) const;

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

extern template class TissueField<float>;
extern template class TissueField<double>;

}  // namespace bleedsim::sph
