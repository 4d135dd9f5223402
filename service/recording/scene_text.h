// The scene's text in a recording, as the message that it is.
#pragma once

#include <string>

#include "idl/scene.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// Recordings outlive the program: fields that are not known are passed over, and nothing is checked. data_loss: no scene text.
Result<scene::Scene> readSceneText(const std::string& text);

}  // namespace bleedsim::recording
