// What decides whether a wound can be opened, rule by rule: a command is refused by the first rule that it breaks, a scene is
// told of all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "service/sph/world_description.h"
#include "service/sph/wound/buried_patch.h"
#include "service/sph/wound/orifice.h"
#include "service/sph/wound/patch_geometry.h"
#include "service/sph/wound/patch_sites.h"
#include "service/sph/wound/throat.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// Where a wound would emit.
struct Opening {
  PatchFrame frame;
  PatchSites patch;
};

/// The patch reaches beyond a side of the domain. Positions from `lowest` to `highest` (m) along the axis would do; none if
/// lowest > highest, because the patch is wider than the domain.
struct PatchOutside {
  std::size_t axis = 0;
  double lowest = 0.0;
  double highest = 0.0;
};

/// The patch would meet its own image across a periodic side.
struct PatchMeetsItself {
  double extent = 0.0;  ///< from the wound's position, m
  double most = 0.0;    ///< what would do, m
};

class WoundRules {
 public:
  /// `speed_of_sound` in m/s; infinite: wounds may be as fast as they like.
  WoundRules(const WorldDescription& description, double speed_of_sound);

  /// invalid_argument: a direction, the shape or the position is no good; capacity: too many sites.
  Result<Opening> plan(const WoundDescription& wound) const;
  /// The first axis along which the patch is outside.
  std::optional<PatchOutside> outside(const Opening& opening) const;
  std::optional<PatchMeetsItself> meetsItself(const Opening& opening) const;
  std::optional<BuriedPatch> buried(const Opening& opening) const;
  /// Both throats' particles could come closer than a spacing.
  bool overlap(const Throat& candidate, const Throat& other) const;
  /// For speedExcess() and checkSpeed().
  ColumnSpeed columnSpeed(const WoundDrive& drive, const Throat& throat) const {
    return {.speed = throat.speedFor(rateOf(drive, throat)), .limit = speed_limit_};
  }

  Throat open(std::uint32_t slot, const Opening& opening, const Throat::Start& start = Throat::Start{0.0, {}}) const {
    return {slot, opening.frame, opening.patch, spacing_, support_radius_, start};
  }
  /// Particles per second.
  double rateOf(const WoundDrive& drive, const Throat& throat) const {
    return driveFlow(drive, throat.area(), rest_density_) / particle_volume_;
  }
  const Domain& domain() const { return domain_; }

 private:
  Domain domain_;
  std::vector<TissueDescription> tissue_;
  double spacing_ = 0.0;
  double support_radius_ = 0.0;
  double rest_density_ = 0.0;
  double particle_volume_ = 0.0;
  double speed_limit_ = 0.0;
};

struct WoundOverlap {
  std::size_t other = 0;  ///< index of the earlier wound
};

/// A broken rule of the wound with this index in the description. A Status is about its shape, directions or position.
struct WoundProblem {
  std::size_t wound = 0;
  std::variant<Status, PatchOutside, PatchMeetsItself, BuriedPatch, WoundOverlap, SpeedExcess> what;
};

/// Every rule that a wound of the description breaks, by rising index. Numbers, and those of the
/// tissue, are taken to be sound.
std::vector<WoundProblem> findWoundProblems(const WorldDescription& description, double speed_of_sound);

}  // namespace bleedsim::sph
