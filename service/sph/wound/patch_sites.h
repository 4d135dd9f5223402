// Where a patch emits: sites in its plane, no two closer than the spacing, about one for each dx^2 of its area.
#pragma once

#include <cstddef>
#include <vector>

#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

inline constexpr std::size_t kMaxPatchSites = 65535;  ///< a driver tag has 16 bits for the site
inline constexpr double kMaxPatchSpacings = 4096.0;   ///< the largest bounding radius, in spacings
/// No two sites are closer than this many spacings; the rest is room for rounding.
inline constexpr double kSiteSeparation = 0.9999;

/// A gap of at most this many spacings fills the throat like blood; beyond it the emission is a jet of separate particles.
inline constexpr double kDenseGap = 1.5;

struct PatchSites {
  std::vector<Vec2> sites;  ///< (u, v) in the patch's plane, m
  double area = 0.0;        ///< of the outline, m^2
  double gap = 0.0;         ///< from one particle of a site to the next along the normal, m
};

/// Disc and ellipse: a square lattice along u and v; polygon: along its principal axes through its centroid; both clipped by the
/// outline. Of the lattice's four half-spacing offsets the one with the fewest sites that make up the area (A/dx^2 to 1.5 A/dx^2)
/// is taken, so that the column moves at flow / area; if there is none, the one nearest to A/dx^2. An outline narrower than the
/// spacing gets one row. A polyline gets rows along its arc, by the same rule across its width, thinned at bends. Always at
/// least one site.
/// gap = max(dx, S dx^3 / A): emitted volume fills the column without overlap.
/// invalid_argument if checkPatch fails; capacity if the patch is beyond kMaxPatchSites or kMaxPatchSpacings.
Result<PatchSites> makePatchSites(const PatchShape& shape, double spacing);

}  // namespace bleedsim::sph
