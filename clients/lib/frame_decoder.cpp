#include "clients/lib/frame_decoder.h"

#include <cmath>
#include <cstring>
#include <fmt/core.h>

#include "clients/lib/wire_text.h"

namespace bleedsim::client {
namespace {

constexpr std::uint32_t kMaxComponents = 16;

/// Bytes of one scalar; 0: unknown.
std::uint64_t scalarSize(std::uint8_t type) {
  switch (type) {
    case bleed_v1_SCALAR_FLOAT32:
    case bleed_v1_SCALAR_UINT32:
      return 4;
    case bleed_v1_SCALAR_UINT16:
      return 2;
    default:
      return 0;
  }
}

Status malformed(std::string message) { return {StatusCode::data_loss, "malformed frame: " + std::move(message)}; }

std::uint32_t componentsOf(std::uint32_t semantic) {
  return semantic == bleed_v1_SEMANTIC_POSITION || semantic == bleed_v1_SEMANTIC_VELOCITY ? 3 : 1;
}

/// The sum over all blocks. At most 16 x 2^32 x 16 x 4 bytes, so 64 bits never overflow.
Result<std::uint64_t> payloadSize(std::span<const bleed_v1_Attribute> attributes, std::uint64_t count) {
  std::uint64_t total = 0;
  std::uint32_t seen = 0;
  for (const bleed_v1_Attribute& a : attributes) {
    const std::uint64_t scalar = scalarSize(a.scalar_type);
    if (scalar == 0) return malformed(fmt::format("scalar type {} is unknown", a.scalar_type));
    if (a.components == 0 || a.components > kMaxComponents) return malformed(fmt::format("{} components", a.components));
    total += count * scalar * a.components;
    if (a.semantic > bleed_v1_SEMANTIC_DENSITY) continue;
    if ((seen >> a.semantic & 1U) != 0) return malformed(fmt::format("attribute {} is there twice", a.semantic));
    seen |= 1U << a.semantic;
    if (a.components != componentsOf(a.semantic)) {
      return malformed(fmt::format("attribute {} has {} components", a.semantic, a.components));
    }
    const bool is_id = a.semantic == bleed_v1_SEMANTIC_ID;
    if (is_id != (a.scalar_type == bleed_v1_SCALAR_UINT32)) {
      return malformed(fmt::format("attribute {} has scalar type {}", a.semantic, a.scalar_type));
    }
    if (!std::isfinite(a.scale) || !std::isfinite(a.offset)) return malformed("a scale or offset is not finite");
  }
  constexpr std::uint32_t kNeeded = 1U << bleed_v1_SEMANTIC_POSITION | 1U << bleed_v1_SEMANTIC_ID;
  if ((seen & kNeeded) != kNeeded) return malformed("positions or ids are missing");
  return total;
}

void readFloats(const bleed_v1_Attribute& attribute, const std::uint8_t* block, std::size_t values, std::vector<float>& into) {
  into.resize(values);
  if (attribute.scalar_type == bleed_v1_SCALAR_FLOAT32) {
    if (values > 0) std::memcpy(into.data(), block, values * sizeof(float));
    return;
  }
  for (std::size_t i = 0; i < values; ++i) {
    std::uint16_t stored = 0;
    std::memcpy(&stored, block + i * sizeof stored, sizeof stored);
    into[i] = attribute.offset + attribute.scale * static_cast<float>(stored);
  }
}

}  // namespace

Status FrameDecoder::unpack(const bleed_v1_Attribute& attribute, const std::uint8_t* block, Frame& into) {
  const std::size_t values = std::size_t{into.header_.count} * attribute.components;
  switch (attribute.semantic) {
    case bleed_v1_SEMANTIC_POSITION:
      readFloats(attribute, block, values, into.positions_);
      for (const float value : into.positions_) {
        if (!std::isfinite(value)) return malformed("a position is not finite");
      }
      break;
    case bleed_v1_SEMANTIC_ID:
      into.ids_.resize(values);
      if (values > 0) std::memcpy(into.ids_.data(), block, values * sizeof(std::uint32_t));
      break;
    case bleed_v1_SEMANTIC_VELOCITY:
      readFloats(attribute, block, values, into.velocities_);
      break;
    case bleed_v1_SEMANTIC_RADIUS:
      readFloats(attribute, block, values, into.radii_);
      break;
    case bleed_v1_SEMANTIC_PLATELET:
      readFloats(attribute, block, values, into.platelets_);
      break;
    case bleed_v1_SEMANTIC_VISCOSITY:
      readFloats(attribute, block, values, into.viscosities_);
      break;
    case bleed_v1_SEMANTIC_DENSITY:
      readFloats(attribute, block, values, into.densities_);
      break;
    default:
      break;
  }
  return {};
}

Status FrameDecoder::decode(const bleed_v1_Frame& wire, Frame& into) {
  const auto attributes = elements(wire.attributes);
  const auto payload = elements(wire.payload);
  const Result<std::uint64_t> size = payloadSize(attributes, wire.count);
  if (!size) return size.status();
  if (*size != payload.size()) {
    return malformed(fmt::format("{} particles need {} bytes, the payload has {}", wire.count, *size, payload.size()));
  }
  if (!std::isfinite(wire.sim_time_s)) return malformed("the time is not finite");

  std::memcpy(into.header_.session.data(), wire.session, into.header_.session.size());
  into.header_.seq = wire.seq;
  into.header_.step = wire.step;
  into.header_.sim_time_s = wire.sim_time_s;
  into.header_.monotonic_stamp_ns = wire.monotonic_stamp_ns;
  into.header_.realtime_stamp_ns = wire.realtime_stamp_ns;
  into.header_.epoch = wire.epoch;
  into.header_.count = wire.count;
  for (std::vector<float>* optional : {&into.velocities_, &into.radii_, &into.platelets_, &into.viscosities_, &into.densities_}) {
    optional->clear();
  }
  const std::uint8_t* block = payload.data();
  for (const bleed_v1_Attribute& a : attributes) {
    if (Status unpacked = unpack(a, block, into); !unpacked) return unpacked;
    block += std::size_t{wire.count} * a.components * scalarSize(a.scalar_type);
  }
  return {};
}

}  // namespace bleedsim::client
