#include "service/recording/frame_layout.h"

#include <algorithm>
#include <fmt/core.h>

namespace bleedsim::recording {

std::size_t scalarBytes(Attribute::ScalarType type) {
  switch (type) {
    case Attribute::FLOAT32:
    case Attribute::UINT32:
      return 4;
    case Attribute::UINT16:
      return 2;
    default:
      return 0;
  }
}

Result<std::vector<AttributeBlock>> layoutOf(const Frame& frame) {
  const auto damaged = [&](const std::string& what) {
    return ::bleedsim::Status{StatusCode::data_loss, fmt::format("frame {}: {}", frame.seq(), what)};
  };
  constexpr std::uint32_t kMaxComponents = 16;
  std::vector<AttributeBlock> blocks;
  const std::span<const char> payload{frame.payload()};
  std::size_t at = 0;
  for (const Attribute& attribute : frame.attributes()) {
    const std::size_t scalar = scalarBytes(attribute.scalar_type());
    const auto semantic = static_cast<int>(attribute.semantic());
    if (scalar == 0 || attribute.components() == 0 || attribute.components() > kMaxComponents) {
      return damaged(fmt::format("attribute {} has {} components of type {}", semantic, attribute.components(),
                                 static_cast<int>(attribute.scalar_type())));
    }
    const std::size_t size = std::size_t{frame.count()} * attribute.components() * scalar;
    if (size > payload.size() - at) return damaged(fmt::format("attribute {} is longer than the payload", semantic));
    blocks.push_back({&attribute, payload.subspan(at, size)});
    at += size;
  }
  if (at != payload.size()) return damaged(fmt::format("the payload has {} bytes instead of {}", payload.size(), at));
  const auto has = [&](Attribute::Semantic semantic, std::uint32_t components) {
    return std::any_of(blocks.begin(), blocks.end(), [&](const AttributeBlock& block) {
      return block.attribute->semantic() == semantic && block.attribute->components() == components;
    });
  };
  if (!has(Attribute::POSITION, 3)) return damaged("it has no positions");
  if (!has(Attribute::ID, 1)) return damaged("it has no particle ids");
  return blocks;
}

}  // namespace bleedsim::recording
