// Samples of the wire -> values of the library.
#pragma once

#include "bleedsim/commands.h"
#include "bleedsim/types.h"
#include "idl/bleed.h"

namespace bleedsim::client {

SessionStatus fromWire(const bleed_v1_Status& wire);
SceneInfo fromWire(const bleed_v1_Scene& wire);
FrameStats fromWire(const bleed_v1_FrameStats& wire);
/// Without arrival_stamp_ns. Codes that this version does not know become ReplyCode::failed.
Reply fromWire(const bleed_v1_Reply& wire);

}  // namespace bleedsim::client
