// Frames as foxglove.PointCloud messages, which Foxglove and Lichtblick draw as moving points.
#pragma once

#include <string>

#include "idl/foxglove/PointCloud.pb.h"
#include "idl/recording.pb.h"
#include "service/recording/mcap_records.h"
#include "service/status/status.h"

namespace bleedsim::recording {

inline constexpr const char* kPointCloudChannel = "/bleed/v1/points";
/// Of positions whose scene is not known.
inline constexpr const char* kDefaultFrameId = "bleedsim";

/// x, y, z and id first, then what else the frame has; vectors as velocity_x, ... and their length as speed. Points lie in
/// `frame_id`, m; the time is the frame's CLOCK_REALTIME. `out` is overwritten. data_loss: as layoutOf().
::bleedsim::Status toPointCloud(const Frame& frame, const std::string& frame_id, foxglove::PointCloud& out);

/// With all imports.
mcap::Schema pointCloudSchema(std::uint16_t id);
mcap::Channel pointCloudChannel(std::uint16_t id, std::uint16_t schema_id);

}  // namespace bleedsim::recording
