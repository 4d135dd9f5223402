#include "service/recording/quantize.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service/recording/frame_layout.h"

namespace bleedsim::recording {
namespace {

constexpr double kSteps = std::numeric_limits<std::uint16_t>::max();

struct Scaling {
  float scale = 0.0F;
  float offset = 0.0F;
};

/// So that the least value is 0 and no value is above kSteps; nothing where floats cannot say it.
std::optional<Scaling> scalingOf(std::span<const float> values) {
  if (values.empty()) return Scaling{};
  float least = values.front();
  float greatest = values.front();
  for (const float value : values) {
    if (!std::isfinite(value)) return {};
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  const double range = static_cast<double>(greatest) - static_cast<double>(least);
  if (!(range <= static_cast<double>(std::numeric_limits<float>::max()))) return {};
  auto scale = static_cast<float>(range / kSteps);
  if (static_cast<double>(scale) * kSteps < range) scale = std::nextafter(scale, std::numeric_limits<float>::max());
  return Scaling{scale, least};
}

void appendQuantized(std::string& payload, std::span<const float> values, const Scaling& scaling) {
  const std::size_t at = payload.size();
  payload.resize(at + values.size() * sizeof(std::uint16_t));
  char* out = payload.data() + at;
  const double offset = static_cast<double>(scaling.offset);
  const double per_step = scaling.scale > 0.0F ? 1.0 / static_cast<double>(scaling.scale) : 0.0;
  for (const float value : values) {
    const double step = std::min((static_cast<double>(value) - offset) * per_step, kSteps);
    const auto stored = static_cast<std::uint16_t>(step + 0.5);
    std::memcpy(out, &stored, sizeof stored);
    out += sizeof stored;
  }
}

}  // namespace

::bleedsim::Status quantize16(Frame& frame) {
  const Result<std::vector<AttributeBlock>> blocks = layoutOf(frame);
  if (!blocks) return blocks.status();
  std::string payload;
  payload.reserve(frame.payload().size());
  std::vector<float> values;
  for (int i = 0; i < frame.attributes_size(); ++i) {
    const std::span<const char> bytes = (*blocks)[static_cast<std::size_t>(i)].bytes;
    Attribute& attribute = *frame.mutable_attributes(i);
    std::optional<Scaling> scaling;
    if (attribute.scalar_type() == Attribute::FLOAT32) {
      values.resize(bytes.size() / sizeof(float));
      if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
      scaling = scalingOf(values);
    }
    if (!scaling) {
      payload.append(bytes.data(), bytes.size());
      continue;
    }
    appendQuantized(payload, values, *scaling);
    attribute.set_scalar_type(Attribute::UINT16);
    attribute.set_scale(scaling->scale);
    attribute.set_offset(scaling->offset);
  }
  frame.set_payload(std::move(payload));
  return {};
}

double maxErrorOf(const Attribute& attribute) {
  if (attribute.scalar_type() != Attribute::UINT16) return 0.0;
  const double scale = static_cast<double>(attribute.scale());
  if (scale == 0.0) return 0.0;
  const double offset = static_cast<double>(attribute.offset());
  const double largest = std::max(std::abs(offset), std::abs(offset + kSteps * scale));
  // offset + scale * stored in floats: the product is at most twice the largest value, and rounds once, as the sum does.
  constexpr double kRounding = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
  return 0.5 * scale + 3.0 * kRounding * largest;
}

void MaxErrors::add(const Attribute& attribute) {
  if (attribute.scalar_type() != Attribute::UINT16) return;
  double& most = by_name_[nameOf(attribute.semantic())];
  most = std::max(most, maxErrorOf(attribute));
}

}  // namespace bleedsim::recording
