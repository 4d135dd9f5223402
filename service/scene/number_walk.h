// What holds for every number of a scene, whatever its field: found by reflection, so that a new field cannot be forgotten.
#pragma once

#include "idl/scene.pb.h"
#include "service/scene/problem_list.h"

namespace bleedsim::scene {

/// Adds a problem for every number that is NaN or infinite.
void reportNonFinite(const Scene& scene, ProblemList& problems);

/// -0 and 0 mean the same and print differently.
void clearNegativeZeros(Scene& scene);

}  // namespace bleedsim::scene
