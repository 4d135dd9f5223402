// Which channels of an MCAP file are topics of a recording.
#pragma once

#include <cstdint>
#include <map>

#include "service/recording/mcap_index.h"
#include "service/recording/topics.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// By channel id. unsupported: a channel of that name holds other messages, or the file has no channel of a recording; one that
/// was cut off may have none yet.
Result<std::map<std::uint16_t, Topic>> topicsOf(const mcap::FileIndex& file);

}  // namespace bleedsim::recording
