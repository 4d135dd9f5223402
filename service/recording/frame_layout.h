// Where a recorded frame's attribute blocks lie in its payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
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

/// Its values as floats, scaled ones decoded: count x components. Not for ids.
void readFloats(const AttributeBlock& block, std::vector<float>& out);

/// The lengths of vectors of so many components, in float.
void vectorLengths(std::span<const float> vectors, std::size_t components, std::vector<float>& out);

/// The block of that meaning; null when the frame has none.
const AttributeBlock* findBlock(std::span<const AttributeBlock> blocks, Attribute::Semantic semantic);

/// "position", "id", ..., "attribute_N" for a meaning that is not known.
std::string nameOf(Attribute::Semantic semantic);

/// 4 for float32 and uint32, 2 for uint16, 0 for unknown types.
std::size_t scalarBytes(Attribute::ScalarType type);

}  // namespace bleedsim::recording
