// Blocks of frames as recordings hold them.
#pragma once

#include <cstdint>

#include "idl/recording.pb.h"

namespace bleedsim::recording::test {

/// Appends a block of 32-bit scalars: `numbers` is a vector or an array of them, `components` for each particle.
template <class Numbers>
void addBlock(Frame& frame, Attribute::Semantic semantic, Attribute::ScalarType type, std::uint32_t components,
              const Numbers& numbers) {
  static_assert(sizeof(numbers[0]) == 4);
  Attribute& attribute = *frame.add_attributes();
  attribute.set_semantic(semantic);
  attribute.set_scalar_type(type);
  attribute.set_components(components);
  frame.mutable_payload()->append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * 4);
}

}  // namespace bleedsim::recording::test
