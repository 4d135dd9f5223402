#include <fmt/format.h>
#include <string>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

void validateBoxTissue(const std::string& path, const BoxTissue& box, ProblemList& problems) {
  requireBox(path, box.has_lower_m(), box.lower_m(), box.has_upper_m(), box.upper_m(), problems);
  if (!BoxTissue::Side_IsValid(box.side())) {
    problems.add(path + ".side",
                 fmt::format("value {} is unknown, known are CONTAINER and OBSTACLE", static_cast<int>(box.side())));
  }
  if (box.open_top() && box.side() == BoxTissue::OBSTACLE) {
    problems.add(path + ".open_top", "value true is for a CONTAINER; drop it or set side: CONTAINER");
  }
}

void validateBowl(const std::string& path, const BowlTissue& bowl, ProblemList& problems) {
  requirePoint(path + ".rim_center_m", bowl.rim_center_m(), problems);
  problems.requireInRange(path + ".sphere_radius_m", bowl.sphere_radius_m(), kBowlRadius);
  const Range depth{kBowlRadius.lower, bowl.sphere_radius_m(), "m, up to sphere_radius_m"};
  if (bowl.sphere_radius_m() >= kBowlRadius.lower) problems.requireInRange(path + ".depth_m", bowl.depth_m(), depth);
}

void validateShape(const std::string& path, const Tissue& tissue, ProblemList& problems) {
  switch (tissue.shape_case()) {
    case Tissue::kPlane:
      requirePoint(path + ".plane.point_m", tissue.plane().point_m(), problems);
      requireDirection(path + ".plane.normal", tissue.plane().normal(), problems);
      return;
    case Tissue::kBox:
      validateBoxTissue(path + ".box", tissue.box(), problems);
      return;
    case Tissue::kBowl:
      validateBowl(path + ".bowl", tissue.bowl(), problems);
      return;
    case Tissue::SHAPE_NOT_SET:
      problems.add(path, "has no shape; give one of plane, box, bowl");
      return;
  }
}

}  // namespace

void validateTissue(const Scene& scene, ProblemList& problems) {
  const int count = requireCount("tissue", scene.tissue_size(), kMaxTissues, problems);
  for (int i = 0; i < count; ++i) {
    const Tissue& tissue = scene.tissue(i);
    const std::string path = fmt::format("tissue[{}]", i);
    requireName(path + ".name", tissue.name(), problems);
    problems.requireInRange(path + ".slip", tissue.slip(), kSlip);
    validateShape(path, tissue, problems);
  }
}

}  // namespace bleedsim::scene
