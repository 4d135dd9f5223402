#include "service/sph/wound/wound_rules.h"

#include <algorithm>
#include <cmath>

#include "service/sph/wound/periodic_offset.h"
#include "service/sph/wound/text.h"

namespace bleedsim::sph {
namespace {

// A patch that ends exactly at a side must not be outside by rounding. Spacings.
constexpr double kRounding = 1e-6;

}  // namespace

WoundRules::WoundRules(const WorldDescription& description, double speed_of_sound)
    : domain_{description.domain},
      tissue_{description.tissue},
      spacing_{description.spacing},
      support_radius_{description.supportRadius()},
      rest_density_{description.rest_density},
      particle_volume_{description.particleVolume()},
      speed_limit_{speed_of_sound / description.compressibility.mach_factor} {}

Result<Opening> WoundRules::plan(const WoundDescription& wound) const {
  Result<PatchFrame> frame = makePatchFrame(wound.position, wound.normal, wound.tangent);
  if (!frame) return frame.status();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (wound.position[axis] >= domain_.lower[axis] && wound.position[axis] <= domain_.upper[axis]) continue;
    return Status{StatusCode::invalid_argument,
                  textOf("wound position ", textOfPoint(wound.position), " m is outside the domain from ",
                         textOfPoint(domain_.lower), " to ", textOfPoint(domain_.upper), " m")};
  }
  Result<PatchSites> patch = makePatchSites(wound.shape, spacing_);
  if (!patch) return patch.status();
  return Opening{*frame, std::move(*patch)};
}

std::optional<PatchOutside> WoundRules::outside(const Opening& opening) const {
  const double slack = kRounding * spacing_;
  for (std::size_t a = 0; a < 3; ++a) {
    if (domain_.periodic[a]) continue;
    const auto axis = static_cast<Eigen::Index>(a);
    double below = 0.0;
    double above = 0.0;
    for (const Vec2& site : opening.patch.sites) {
      const double offset = opening.frame.toWorld(site, 0.0)[axis] - opening.frame.origin[axis];
      below = std::min(below, offset);
      above = std::max(above, offset);
    }
    const PatchOutside allowed{a, domain_.lower[axis] - below, domain_.upper[axis] - above};
    const double position = opening.frame.origin[axis];
    if (position < allowed.lowest - slack || position > allowed.highest + slack) return allowed;
  }
  return std::nullopt;
}

std::optional<PatchMeetsItself> WoundRules::meetsItself(const Opening& opening) const {
  double extent = 0.0;
  for (const Vec2& site : opening.patch.sites) extent = std::max(extent, site.norm());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!domain_.periodic[axis]) continue;
    const auto a = static_cast<Eigen::Index>(axis);
    const double room = domain_.upper[a] - domain_.lower[a] - spacing_;
    if (2.0 * extent > room) return PatchMeetsItself{extent, 0.5 * room};
  }
  return std::nullopt;
}

std::optional<BuriedPatch> WoundRules::buried(const Opening& opening) const {
  return findBuried(opening.frame, opening.patch, tissue_, domain_, spacing_);
}

bool WoundRules::overlap(const Throat& candidate, const Throat& other) const {
  const double separation = kSiteSeparation * spacing_;
  const double apart = nearestOffset(domain_, other.frame().origin, candidate.frame().origin).norm();
  if (apart > other.reach() + candidate.reach() + spacing_) return false;
  // Points along the new columns, half a spacing apart, against the other column as a solid of its sites.
  for (const Vec2& site : candidate.sites()) {
    for (double height = 0.5 * spacing_; height >= -candidate.depth(); height -= 0.5 * spacing_) {
      const Vec3 point = candidate.frame().toWorld(site, height);
      const Vec3 local = other.frame().toLocal(nearestOffset(domain_, other.frame().origin, point));
      if (local.z() > spacing_ || local.z() < -other.depth() - spacing_) continue;
      bool clear = true;
      other.grid().forEachNear({local.x(), local.y()},
                               [&](std::uint32_t, double squared) { clear = clear && squared >= separation * separation; });
      if (!clear) return true;
    }
  }
  return false;
}

std::vector<WoundProblem> findWoundProblems(const WorldDescription& description, double speed_of_sound) {
  const WoundRules rules{description, speed_of_sound};
  std::vector<WoundProblem> problems;
  std::vector<std::optional<Throat>> throats;
  for (std::size_t i = 0; i < description.wounds.size(); ++i) {
    const WoundDescription& wound = description.wounds[i];
    const Result<Opening> opening = rules.plan(wound);
    throats.emplace_back();
    if (!opening) {
      problems.push_back({i, opening.status()});
      continue;
    }
    if (const auto outside = rules.outside(*opening)) problems.push_back({i, *outside});
    if (const auto meets_itself = rules.meetsItself(*opening)) problems.push_back({i, *meets_itself});
    if (auto buried = rules.buried(*opening)) problems.push_back({i, std::move(*buried)});
    throats[i].emplace(rules.open(1, *opening));
    for (std::size_t other = 0; other < i; ++other) {
      if (throats[other] && rules.overlap(*throats[i], *throats[other])) problems.push_back({i, WoundOverlap{other}});
    }
    const std::optional<SpeedExcess> excess = speedExcess(rules.columnSpeed(wound.drive, *throats[i]), wound.drive);
    if (excess) problems.push_back({i, *excess});
  }
  return problems;
}

}  // namespace bleedsim::sph
