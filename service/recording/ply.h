// A frame as a .ply file: points, binary little-endian.
#pragma once

#include <string>

#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// Properties: float x, y, z, uint id, then what else the frame has as float. Number and time of the frame stand in comments.
/// data_loss: as layoutOf().
Result<std::string> toPly(const Frame& frame);

}  // namespace bleedsim::recording
