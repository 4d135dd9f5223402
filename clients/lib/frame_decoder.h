// Wire frame -> Frame: every length is checked against the count before anything is read.
#pragma once

#include "bleedsim/frame.h"
#include "idl/bleed.h"

namespace bleedsim::client {

class FrameDecoder {
 public:
  /// data_loss: attribute list and payload contradict each other, positions or ids are missing, or a position is not finite.
  /// `into` is then unspecified. Attributes of unknown meaning are skipped, so that a newer service may add some.
  static Status decode(const bleed_v1_Frame& wire, Frame& into);

 private:
  static Status unpack(const bleed_v1_Attribute& attribute, const std::uint8_t* block, Frame& into);
};

}  // namespace bleedsim::client
