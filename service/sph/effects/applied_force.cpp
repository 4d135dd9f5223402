#include "service/sph/effects/applied_force.h"

#include <cmath>
#include <string>

#include "service/sph/wound/text.h"
#include "service/status/quantity_limits.h"

namespace bleedsim::sph {
namespace {

Status invalid(std::string message) { return {StatusCode::invalid_argument, std::move(message)}; }

/// How far out of the domain along each axis, m; a periodic side is never far.
Vec3 excessBeyond(const Domain& domain, const Vec3& position) {
  Vec3 offset = (domain.lower - position).cwiseMax(position - domain.upper).cwiseMax(0.0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (domain.periodic[static_cast<std::size_t>(axis)]) offset[axis] = 0.0;
  }
  return offset;
}

}  // namespace

Status checkForce(const SetForce& source, const Domain& domain) {
  if (!source.position.allFinite()) return invalid("the force's position is not finite");
  if (!source.force.allFinite() || source.force.norm() > kForce.upper) {
    return invalid(textOf("the force must be finite and at most ", kForce.upper, " N"));
  }
  const double diagonal = (domain.upper - domain.lower).norm();
  if (!(source.radius > 0.0) || source.radius > diagonal) {
    return invalid(textOf("the force's radius is ", source.radius, " m; use more than 0 and at most ", diagonal,
                          " m, the scene's diagonal"));
  }
  if (std::isnan(source.until)) return invalid("the force's end is not a number");
  const Vec3 excess = excessBeyond(domain, source.position);
  if (excess.norm() >= source.radius) {
    Eigen::Index axis = 0;
    excess.maxCoeff(&axis);
    // A reply holds 127 bytes: values first, then what to do.
    return invalid(textOf("position ", textOfPoint(source.position), " m, radius ", source.radius, " m: outside the domain, ",
                          "xyz"[axis], " from ", domain.lower[axis], " to ", domain.upper[axis], " m; move it in"));
  }
  return {};
}

}  // namespace bleedsim::sph
