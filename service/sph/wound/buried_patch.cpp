#include "service/sph/wound/buried_patch.h"

#include <algorithm>
#include <cmath>

#include "service/sph/tissue/signed_distance.h"
#include "service/sph/wound/periodic_offset.h"
#include "service/sph/wound/text.h"
#include "service/sph/wound/throat.h"

namespace bleedsim::sph {
namespace {

constexpr double kRounding = 1e-6;  // spacings

Vec3 asVector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// With the digits that a reader needs, so that a reply has room for it.
std::string shortPoint(const Vec3& point, double unit) {
  Vec3 rounded = (point / unit).array().round() * unit;
  rounded += Vec3::Zero();  // no -0
  return textOfPoint(rounded);
}
std::string placeText(const Vec3& point) { return shortPoint(point, 1e-5); }
std::string directionText(const Vec3& direction) { return shortPoint(direction, 1e-3); }
std::string depthText(double depth) { return textOf(std::round(depth * 1e5) * 1e-2, " mm"); }

class Burial {
 public:
  Burial(const PatchFrame& frame, const PatchSites& patch, const Domain& domain, double spacing)
      : frame_{frame}, patch_{patch}, domain_{domain}, release_{kReleaseHeight * spacing}, depth_{kRounding * spacing} {
    for (const Vec2& site : patch.sites) extent_ = std::max(extent_, site.norm());
  }

  std::optional<BuriedPatch> findIn(const std::vector<TissueDescription>& tissue) {
    for (const TissueDescription& one : tissue) search(one);
    if (tissue_ == nullptr) return std::nullopt;
    const std::string of = tissue_->name.empty() ? std::string{} : textOf(" of '", tissue_->name, "'");
    if (const auto wall = at(frame_.origin); wall.value < -release_) {
      const Vec3 surface = inDomain(frame_.origin) - wall.value * asVector(wall.normal);
      return BuriedPatch{BuriedPatch::Fault::position,
                         textOf(textOfPoint(frame_.origin), " m is ", depthText(-wall.value), " inside tissue: use ",
                                placeText(surface), " m, on the surface", of)};
    }
    const Vec3 site = frame_.toWorld(site_, 0.0);
    const auto wall = at(site);
    const Vec3 normal = asVector(wall.normal);
    if (wall.value >= -release_ && frame_.normal.dot(normal) < 0.0) {
      return BuriedPatch{BuriedPatch::Fault::normal,
                         textOf(directionText(frame_.normal), " lets blood out ", depthText(depth_), " inside tissue at ",
                                placeText(frame_.origin), " m: turn it to the blood's side, ", directionText(normal), of)};
    }
    return BuriedPatch{BuriedPatch::Fault::extent,
                       textOf("reaches ", depthText(-wall.value), " into tissue at ", placeText(site),
                              " m: move it away, make it smaller or turn its normal to ", directionText(normal), of)};
  }

 private:
  Vec3 inDomain(Vec3 point) const {
    wrapInto(domain_, point);
    return point;
  }
  SignedDistance<double> at(const Vec3& point) const { return signedDistance(tissue_->shape, inDomain(point)); }

  /// Remembers the site that sets its particles free deepest, if any does inside.
  void search(const TissueDescription& tissue) {
    const auto& periodic = domain_.periodic;
    const bool wraps = std::any_of(periodic.begin(), periodic.end(), [](bool side) { return side; });
    if (!wraps && signedDistance(tissue.shape, frame_.origin).value > extent_ + release_) return;
    for (const Vec2& site : patch_.sites) {
      const SignedDistance<double> wall = signedDistance(tissue.shape, inDomain(frame_.toWorld(site, release_)));
      const double sagitta = 0.5 * wall.curvature * site.squaredNorm();
      const double depth = -wall.value - sagitta;
      if (!(depth > depth_)) continue;
      depth_ = depth;
      site_ = site;
      tissue_ = &tissue;
    }
  }

  const PatchFrame& frame_;
  const PatchSites& patch_;
  const Domain& domain_;
  double extent_ = 0.0;   // m
  double release_ = 0.0;  // m
  double depth_ = 0.0;    // of the deepest so far, m
  Vec2 site_ = Vec2::Zero();
  const TissueDescription* tissue_ = nullptr;  // none: no site is inside
};

}  // namespace

std::optional<BuriedPatch> findBuried(const PatchFrame& frame, const PatchSites& patch,
                                      const std::vector<TissueDescription>& tissue, const Domain& domain, double spacing) {
  return Burial{frame, patch, domain, spacing}.findIn(tissue);
}

}  // namespace bleedsim::sph
