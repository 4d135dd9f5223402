// Scene text, or that of a part of it, to its protobuf message, with every problem of the text itself.
#pragma once

#include <google/protobuf/message.h>
#include <string>
#include <string_view>

#include "service/scene/problem_list.h"

namespace bleedsim::scene {

/// Unknown fields are skipped and reported, all of them, with the nearest known name. False if the text cannot be read to its end
/// (a syntax error); the message then holds only a part of the scene and is not worth validating.
bool readText(std::string_view text, google::protobuf::Message& message, ProblemList& problems);

/// The one way in which a message is written.
std::string writeText(const google::protobuf::Message& message);

}  // namespace bleedsim::scene
