// "Did you mean": the known name that is nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bleedsim::scene {

/// The first candidate that is `name` with something after an underscore, e.g. its unit; else the one with the smallest edit
/// distance, the first of equals; empty if none is near enough to be meant (more than half of the letters, at least 2, would have
/// to change).
std::string nearestName(std::string_view name, std::span<const std::string> candidates);

}  // namespace bleedsim::scene
