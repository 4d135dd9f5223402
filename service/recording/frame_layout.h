// Where a recorded frame's attribute blocks lie in its payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

struct AttributeBlock {
  const Attribute* attribute = nullptr;
  std::span<const char> bytes;  ///< count x components scalars, little-endian
};

/// Blocks in payload order. data_loss: sizes that contradict the payload, unknown scalar types, or no positions and ids.
Result<std::vector<AttributeBlock>> layoutOf(const Frame& frame);

/// 4 for float32 and uint32, 2 for uint16, 0 for unknown types.
std::size_t scalarBytes(Attribute::ScalarType type);

}  // namespace bleedsim::recording
