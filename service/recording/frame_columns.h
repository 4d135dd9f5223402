// A frame as named columns of numbers, one number for each particle: what tables and point files are made of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

struct FrameColumns {
  struct Column {
    std::string name;  ///< x, y, z, vx, vy, vz, radius, ...
    std::vector<float> values;
  };
  std::vector<Column> columns;  ///< positions first, then in the frame's order; scaled numbers decoded
  std::vector<std::uint32_t> ids;

  const Column* find(const std::string& name) const;
};

/// `out` is overwritten. data_loss: as layoutOf().
::bleedsim::Status toColumns(const Frame& frame, FrameColumns& out);

}  // namespace bleedsim::recording
