// Frames with 16-bit numbers instead of 32-bit ones: half the size, at an error that the frame itself states.
#pragma once

#include <map>
#include <string>

#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// Replaces each float block by 16-bit numbers over its own range, from its least to its greatest value; ids stay as they are. A
/// block with a value that is not finite, or with a range beyond float, stays too. data_loss: as layoutOf().
::bleedsim::Status quantize16(Frame& frame);

/// Largest difference between a value and what its block gives back, in the attribute's unit: half a step, and the rounding of
/// floats. 0 for blocks that are exact.
double maxErrorOf(const Attribute& attribute);

/// The largest errors of many frames.
class MaxErrors {
 public:
  void add(const Attribute& attribute);
  /// By the attribute's name; only those that were ever quantised.
  const std::map<std::string, double>& byName() const { return by_name_; }

 private:
  std::map<std::string, double> by_name_;
};

}  // namespace bleedsim::recording
