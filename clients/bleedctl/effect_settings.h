// The settings of effects as they stand in the normalised text of a scene.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace bleedsim::bleedctl {

/// By effect, the text between its braces in one line, as `effect on --set` takes it. Normalised text nests by two blanks, one
/// field a line; anything else gives fewer entries, never wrong ones.
std::map<std::string, std::string> effectSettings(std::string_view scene_text);

}  // namespace bleedsim::bleedctl
