#include "service/recording/frame_layout.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
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

std::string nameOf(Attribute::Semantic semantic) {
  switch (semantic) {
    case Attribute::POSITION:
      return "position";
    case Attribute::ID:
      return "id";
    case Attribute::VELOCITY:
      return "velocity";
    case Attribute::RADIUS:
      return "radius";
    case Attribute::PLATELET:
      return "platelet";
    case Attribute::VISCOSITY:
      return "viscosity";
    case Attribute::DENSITY:
      return "density";
    default:
      return fmt::format("attribute_{}", static_cast<int>(semantic));
  }
}

void readFloats(const AttributeBlock& block, std::vector<float>& out) {
  const Attribute& attribute = *block.attribute;
  out.resize(block.bytes.size() / scalarBytes(attribute.scalar_type()));
  if (out.empty()) return;
  if (attribute.scalar_type() != Attribute::UINT16) {
    std::memcpy(out.data(), block.bytes.data(), block.bytes.size());
    return;
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::uint16_t stored = 0;
    std::memcpy(&stored, block.bytes.data() + i * sizeof stored, sizeof stored);
    out[i] = attribute.offset() + attribute.scale() * static_cast<float>(stored);
  }
}

void vectorLengths(std::span<const float> vectors, std::size_t components, std::vector<float>& out) {
  out.resize(vectors.size() / components);
  for (std::size_t i = 0; i < out.size(); ++i) {
    float sum = 0.0F;
    for (const float part : vectors.subspan(i * components, components)) sum += part * part;
    out[i] = std::sqrt(sum);
  }
}

const AttributeBlock* findBlock(std::span<const AttributeBlock> blocks, Attribute::Semantic semantic) {
  const auto found = std::find_if(blocks.begin(), blocks.end(),
                                  [&](const AttributeBlock& block) { return block.attribute->semantic() == semantic; });
  return found == blocks.end() ? nullptr : &*found;
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
    const AttributeBlock* block = findBlock(blocks, semantic);
    const bool whole = block != nullptr && block->attribute->scalar_type() == Attribute::UINT32;
    return block != nullptr && block->attribute->components() == components && whole == (semantic == Attribute::ID);
  };
  if (!has(Attribute::POSITION, 3)) return damaged("it has no positions");
  if (!has(Attribute::ID, 1)) return damaged("it has no particle ids");
  return blocks;
}

}  // namespace bleedsim::recording
