// Whether a wound would bleed inside tissue. A throat sets its particles free half a spacing in front of the patch; that place
// must not lie in tissue, or blood comes out where there is no room for it. A patch facing the blood may so be up to half a
// spacing deep, which forgives a position picked on a mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "service/sph/wound/patch_geometry.h"
#include "service/sph/wound/patch_sites.h"

namespace bleedsim::sph {

struct BuriedPatch {
  enum class Fault {
    position,  ///< the wound's position is inside
    normal,    ///< the patch is on tissue and points into it
    extent,    ///< a part of the patch is inside
  };
  Fault fault = Fault::position;
  /// What is wrong and what to do, to stand behind the name of what `fault` says: position and normal begin with their value.
  std::string reason;
};

/// By the site that lies deepest. A flat patch on a hollow reaches into its tissue by its sagitta; that much is forgiven.
/// Numbers of the tissue are taken to be sound.
std::optional<BuriedPatch> findBuried(const PatchFrame& frame, const PatchSites& patch,
                                      const std::vector<TissueDescription>& tissue, const Domain& domain, double spacing);

}  // namespace bleedsim::sph
