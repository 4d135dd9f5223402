#include "service/sph/tissue/tissue_field.h"

#include <limits>
#include <string>

namespace bleedsim::sph {
namespace {

Status refusal(const TissueDescription& tissue, const std::string& what) {
  return {StatusCode::invalid_argument, "tissue '" + tissue.name + "': " + what};
}

Status checkPlane(const TissueDescription& tissue, const PlaneShape& plane) {
  if (!plane.point.allFinite()) return refusal(tissue, "the plane's point is not finite; give three finite coordinates in m");
  const double length = plane.normal.norm();
  if (!(length > 1e-6 && length < 1e6)) {
    return refusal(tissue, "the plane's normal has length " + std::to_string(length) + "; give a vector of length 1");
  }
  return {};
}

Status checkBox(const TissueDescription& tissue, const BoxShape& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool finite = std::isfinite(box.lower[axis]) && std::isfinite(box.upper[axis]);
    if (finite && box.lower[axis] < box.upper[axis]) continue;
    return refusal(tissue, "the box spans " + std::to_string(box.lower[axis]) + " to " + std::to_string(box.upper[axis]) +
                               " m along axis " + std::to_string(axis) + "; lower must be finite and below upper");
  }
  return {};
}

Status checkBowl(const TissueDescription& tissue, const BowlShape& bowl) {
  if (!bowl.rim_center.allFinite()) return refusal(tissue, "the rim's centre is not finite; give three finite coordinates in m");
  if (!(bowl.sphere_radius > 0.0 && std::isfinite(bowl.sphere_radius))) {
    return refusal(tissue, "sphere_radius is " + std::to_string(bowl.sphere_radius) + " m; it must be finite and above 0");
  }
  if (!(bowl.depth > 0.0 && bowl.depth <= bowl.sphere_radius)) {
    return refusal(tissue, "depth is " + std::to_string(bowl.depth) + " m; it must be above 0 and at most sphere_radius, " +
                               std::to_string(bowl.sphere_radius) + " m");
  }
  return {};
}

Status checkTissue(const TissueDescription& tissue) {
  if (!(tissue.slip >= 0.0 && tissue.slip <= 1.0)) {
    return refusal(tissue, "slip is " + std::to_string(tissue.slip) + "; it must be between 0 and 1");
  }
  if (const auto* plane = std::get_if<PlaneShape>(&tissue.shape)) return checkPlane(tissue, *plane);
  if (const auto* box = std::get_if<BoxShape>(&tissue.shape)) return checkBox(tissue, *box);
  return checkBowl(tissue, std::get<BowlShape>(tissue.shape));
}

template <class Real>
void addScaled(std::array<Real, 3>& sum, Real factor, const std::array<Real, 3>& vector) {
  for (int axis = 0; axis < 3; ++axis) sum[axis] += factor * vector[axis];
}

}  // namespace

template <class Real>
Result<TissueField<Real>> TissueField<Real>::create(const std::vector<TissueDescription>& tissue, const ShareSettings& settings) {
  if (tissue.size() > kMostTissues) {
    return Status{StatusCode::capacity, std::to_string(tissue.size()) + " tissues; at most " + std::to_string(kMostTissues) +
                                            " are possible: merge or remove some"};
  }
  for (const TissueDescription& one : tissue) {
    if (Status status = checkTissue(one); !status) return status;
  }
  TissueField field;
  if (tissue.empty()) return field;
  field.reach_ = static_cast<Real>(settings.kernel.h * settings.radii.largest);
  field.radii_ = RadiusScale<Real>{settings.radii};
  field.spring_reach_ = static_cast<Real>(0.5 * settings.spacing);
  field.spring_scale_ = static_cast<Real>(1.0 / (settings.spacing * settings.spacing));
  field.gap_ = static_cast<Real>(kProjectionGap * settings.spacing);
  field.plane_table_.emplace(settings, 0.0);
  for (const TissueDescription& one : tissue) {
    const Real grip = static_cast<Real>(1.0 - one.slip);
    if (const auto* plane = std::get_if<PlaneShape>(&one.shape)) {
      field.planes_.push_back({PlaneSurface<Real>{*plane}, grip});
    } else if (const auto* box = std::get_if<BoxShape>(&one.shape)) {
      if (box->obstacle) {
        field.obstacles_.push_back({ObstacleSurface<Real>{*box}, grip});
        continue;
      }
      for (const PlaneShape& face : containerFaces(*box)) field.planes_.push_back({PlaneSurface<Real>{face}, grip});
    } else if (const auto* bowl = std::get_if<BowlShape>(&one.shape)) {
      field.bowls_.push_back({BowlSurface<Real>{*bowl}, grip, ShareTables<Real>{settings, 1.0 / bowl->sphere_radius}});
    }
  }
  return field;
}

template <class Real>
Real TissueField<Real>::scaledFriction(Real share, Real distance, const Own& own) const {
  const Share<Real> plane = plane_table_->at(distance, own);
  if (!(plane.share > 0)) return 0;
  return frictionOf(plane, distance) * std::min(share / plane.share, Real{2});
}

template <class Real>
void TissueField<Real>::addPlane(const Plane& plane, Real distance, const Own& own, WallTerms<Real>& terms) const {
  const Share<Real> share = plane_table_->at(distance, own);
  WallTerm<Real> term{};
  term.distance = distance;
  term.normal = plane.surface.normal();
  term.share = share.share;
  addScaled(term.gradient, share.slope, term.normal);
  term.friction = frictionOf(share, distance) * plane.grip;
  term.grip = plane.grip;
  terms.add(term);
}

// A block is what two facing planes leave of each other, N_lower + N_upper - 1 along an axis, and of this the product over the
// axes, with N = L/full: the share of a part of space, not of the lattice's rounding of it.
template <class Real>
void TissueField<Real>::addObstacle(const Obstacle& obstacle, Real x, Real y, Real z, const Own& own,
                                    WallTerms<Real>& terms) const {
  const ShareTables<Real>& table = *plane_table_;
  const Real full = table.full(own);
  const std::array<Real, 3> point{x, y, z};
  std::array<Real, 3> filled{};
  std::array<Real, 3> slope{};
  for (int axis = 0; axis < 3; ++axis) {
    const Share<Real> below = table.at(obstacle.surface.lower(axis) - point[axis], own);
    const Share<Real> above = table.at(point[axis] - obstacle.surface.upper(axis), own);
    const Real most = std::max(below.share, above.share) / full;  // 1 where the block is thick: no rounding is left over
    filled[axis] = (most - 1) + std::min(below.share, above.share) / full;
    slope[axis] = (above.slope - below.slope) / full;
    if (filled[axis] > 0) continue;
    filled[axis] = 0;
    slope[axis] = 0;
  }
  const SignedDistance<Real> nearest = obstacle.surface.at(x, y, z);
  WallTerm<Real> term{};
  term.distance = nearest.value;
  term.normal = nearest.normal;
  term.share = full * filled[0] * filled[1] * filled[2];
  term.gradient = {full * slope[0] * filled[1] * filled[2], full * filled[0] * slope[1] * filled[2],
                   full * filled[0] * filled[1] * slope[2]};
  term.friction = scaledFriction(term.share, nearest.value, own) * obstacle.grip;
  term.grip = obstacle.grip;
  terms.add(term);
}

// The tissue is behind the plane and outside the sphere at once. w changes along the sphere: grad c = -(z - c n)/r, and
// d asin(c)/dc = 1/sqrt(1 - c^2) makes grad w a unit vector across n, over r.
template <class Real>
void TissueField<Real>::addBowl(const Bowl& bowl, Real x, Real y, Real z, const Own& own, WallTerms<Real>& terms) const {
  if (!bowl.surface.nears({x, y, z}, {}, reach_)) return;
  const auto part = bowl.surface.parts(x, y, z);
  const std::array<Real, 3>& n = part.sphere_normal;
  WallTerm<Real> term{};
  term.grip = bowl.grip;
  if (bowl.surface.isHollow(z, reach_)) {  // where most touch: the hollow's table knows all, and it is the nearest
    const Share<Real> hollow = bowl.table.at(part.sphere, own);
    term.distance = part.sphere;
    term.normal = n;
    term.share = hollow.share;
    addScaled(term.gradient, hollow.slope, n);
    term.friction = frictionOf(hollow, part.sphere) * bowl.grip;
    terms.add(term);
    return;
  }
  const ShareTables<Real>& table = *plane_table_;
  const SignedDistance<Real> nearest = bowl.surface.at(x, y, z, part);
  term.distance = nearest.value;
  term.normal = nearest.normal;
  if (part.sphere <= -reach_) {
    const Share<Real> plane = table.at(part.plane, own);
    term.share = plane.share;
    term.gradient[2] = plane.slope;
  } else {
    const Share<Real> plane = table.at(part.plane, own);
    const Share<Real> hollow = bowl.table.at(part.sphere, own);
    const Real full = table.full(own);
    const Real c = n[2];
    const Overlap<Real> both = overlapOf(plane.share / full, hollow.share / full, c);
    term.share = full * both.value;
    term.gradient[2] = both.by_first * plane.slope;
    addScaled(term.gradient, both.by_second * hollow.slope, n);
    const Real across = std::sqrt(std::max(Real{0}, 1 - c * c));
    if (across > 0 && part.center_distance > 0) {
      const Real sign = c < 0 ? Real{1} : Real{-1};
      const Real factor = sign * static_cast<Real>(0.6366197723675814) * full * both.by_weight / (part.center_distance * across);
      addScaled(term.gradient, -factor * c, n);
      term.gradient[2] += factor;
    }
  }
  term.friction = scaledFriction(term.share, nearest.value, own) * bowl.grip;
  terms.add(term);
}

template <class Real>
typename TissueField<Real>::Nearby TissueField<Real>::nearby(const std::array<Real, 3>& lower,
                                                             const std::array<Real, 3>& upper) const {
  std::array<Real, 3> center{};
  std::array<Real, 3> half{};
  for (std::size_t a = 0; a < 3; ++a) {
    center[a] = Real(0.5) * (lower[a] + upper[a]);
    half[a] = upper[a] - center[a];
    if (!(half[a] >= Real(0))) return {Nearness::any, 0};
  }
  const Real reach = Real(1.001) * reach_;  // more than rounding, so that no touching point is missed
  for (const Obstacle& obstacle : obstacles_) {
    if (obstacle.surface.leastAbout(center, half) < reach) return {Nearness::any, 0};
  }
  Nearby near;
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    if (!(planes_[k].surface.leastAbout(center, half) < reach)) continue;
    if (near.nearness != Nearness::none) return {Nearness::any, 0};
    near = {Nearness::plane, k};
  }
  for (std::size_t k = 0; k < bowls_.size(); ++k) {
    const BowlSurface<Real>& surface = bowls_[k].surface;
    if (!surface.nears(center, half, reach)) continue;
    if (near.nearness != Nearness::none || !surface.isHollow(upper[2], reach_)) return {Nearness::any, 0};
    near = {Nearness::hollow, k};
  }
  return near;
}

template <class Real>
bool TissueField<Real>::sample(Real x, Real y, Real z, WallSample<Real>& out, Real radius) const {
  WallTerms<Real> terms;
  const Own own = radii_.at(radius);
  for (const Plane& plane : planes_) {
    const Real distance = plane.surface.value(x, y, z);
    if (distance < reach_) addPlane(plane, distance, own, terms);
  }
  for (const Obstacle& obstacle : obstacles_) {
    if (obstacle.surface.faceDistance(x, y, z) < reach_) addObstacle(obstacle, x, y, z, own, terms);
  }
  for (const Bowl& bowl : bowls_) addBowl(bowl, x, y, z, own, terms);
  if (terms.size() == 0) return false;

  const CombinedShare<Real> combined = combineShares(terms);
  out = {};
  out.share = combined.share;
  out.distance = std::numeric_limits<Real>::infinity();
  for (int k = 0; k < terms.size(); ++k) {
    const WallTerm<Real>& term = terms[k];
    addScaled(out.gradient, combined.weight[k], term.gradient);
    out.friction += combined.weight[k] * term.friction;
    if (term.distance < spring_reach_) addScaled(out.spring, (spring_reach_ - term.distance) * spring_scale_, term.normal);
    if (term.distance >= out.distance) continue;
    out.distance = term.distance;
    out.normal = term.normal;
    out.grip = term.grip;
  }
  out.friction = std::min(out.friction, Real{0});
  return true;
}

template <class Real>
Real TissueField<Real>::distance(Real x, Real y, Real z) const {
  Real nearest = std::numeric_limits<Real>::infinity();
  for (const Plane& plane : planes_) nearest = std::min(nearest, plane.surface.value(x, y, z));
  for (const Obstacle& obstacle : obstacles_) nearest = std::min(nearest, obstacle.surface.at(x, y, z).value);
  for (const Bowl& bowl : bowls_) nearest = std::min(nearest, bowl.surface.at(x, y, z).value);
  return nearest;
}

template <class Real>
bool TissueField<Real>::project(std::array<Real, 3>& position, std::array<Real, 3>& normal) const {
  bool moved = false;
  const auto push_out = [&](Real distance, const std::array<Real, 3>& direction) {
    if (!(distance < 0)) return false;
    addScaled(position, gap_ - distance, direction);
    normal = direction;
    moved = true;
    return true;
  };
  for (int round = 0; round < kMostProjections; ++round) {
    bool inside = false;
    for (const Plane& plane : planes_) {
      inside |= push_out(plane.surface.value(position[0], position[1], position[2]), plane.surface.normal());
    }
    for (const Obstacle& obstacle : obstacles_) {
      const SignedDistance<Real> nearest = obstacle.surface.at(position[0], position[1], position[2]);
      inside |= push_out(nearest.value, nearest.normal);
    }
    for (const Bowl& bowl : bowls_) {
      const SignedDistance<Real> nearest = bowl.surface.at(position[0], position[1], position[2]);
      inside |= push_out(nearest.value, nearest.normal);
    }
    if (!inside) break;
  }
  return moved;
}

template class TissueField<float>;
template class TissueField<double>;

}  // namespace bleedsim::sph
