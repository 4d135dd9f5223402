// Every rule that a scene must follow. Each function adds all the problems that it finds; none changes the scene, which must have
// its defaults filled in.
#pragma once

#include <optional>
#include <string_view>

#include "idl/scene.pb.h"
#include "service/scene/problem_list.h"

namespace bleedsim::scene {

/// All of the following but validateWorld().
void validate(const Scene& scene, ProblemList& problems);

/// Box, periodic sides, capacity, resolution, fluid, compressibility, step limit.
void validateDomain(const Scene& scene, ProblemList& problems);
/// The values of the effects, each for itself.
void validateEffects(const Scene& scene, ProblemList& problems);
/// Effects that cannot work together, or without something else of the scene.
void validateCombinations(const Scene& scene, ProblemList& problems);
/// Under model LITERAL: what that does not read, and what to set instead.
void validateLiteralModel(const Scene& scene, ProblemList& problems);
/// Outputs and command bounds.
void validateOutput(const Scene& scene, ProblemList& problems);
void validateTissue(const Scene& scene, ProblemList& problems);
void validateWounds(const Scene& scene, ProblemList& problems);
void validateFluidBlocks(const Scene& scene, ProblemList& problems);
/// What the solver would refuse: wounds that are too fast, overlap, reach out of the domain or bleed inside tissue, outlines that
/// cross themselves, blocks that the effects cannot work with, what the model does not know. After the others: wounds and tissue
/// that have problems already are left out. `speed_of_sound` (m/s) is that of a world that runs; without it the scene's own.
void validateWorld(const Scene& scene, std::optional<double> speed_of_sound, ProblemList& problems);
/// Names and the description.
void validateText(const Scene& scene, ProblemList& problems);

/// UTF-8 of at most 64 bytes without control characters. True if it is.
bool requireName(std::string_view path, std::string_view name, ProblemList& problems);
/// Each coordinate within limits.h.
void requirePoint(std::string_view path, const Vec3& point, ProblemList& problems);
/// Not zero; tiny and huge lengths are refused as well, since they do not normalise well.
void requireDirection(std::string_view path, const Vec3& direction, ProblemList& problems);
/// lower < upper on each axis, both given and within limits.h. True if the box is usable.
bool requireBox(std::string_view path, bool has_lower, const Vec3& lower, bool has_upper, const Vec3& upper,
                ProblemList& problems);
/// A list that is too long; the caller looks at the first `most` members only.
int requireCount(std::string_view path, int count, int most, ProblemList& problems, std::string_view remedy = "leave some out");

}  // namespace bleedsim::scene
