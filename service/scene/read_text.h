// Scene text to its protobuf message, with every problem of the text itself.
#pragma once

#include <string_view>

#include "idl/scene.pb.h"
#include "service/scene/problem_list.h"

namespace bleedsim::scene {

/// Unknown fields are skipped and reported, all of them, with the nearest known name. False if the text cannot be read to its end
/// (a syntax error); the message then holds only a part of the scene and is not worth validating.
bool readText(std::string_view text, Scene& message, ProblemList& problems);

/// The one way in which a message is written.
std::string writeText(const Scene& message);

}  // namespace bleedsim::scene
