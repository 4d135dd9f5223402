#include "service/recording/frame_columns.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "service/recording/frame_layout.h"

namespace bleedsim::recording {
namespace {

constexpr std::array<const char*, 3> kPosition{"x", "y", "z"};
constexpr std::array<const char*, 3> kVelocity{"vx", "vy", "vz"};

std::string columnName(const Attribute& attribute, std::uint32_t component) {
  if (attribute.components() == 3 && attribute.semantic() == Attribute::POSITION) return kPosition[component];
  if (attribute.components() == 3 && attribute.semantic() == Attribute::VELOCITY) return kVelocity[component];
  const std::string name = nameOf(attribute.semantic());
  return attribute.components() == 1 ? name : name + "_" + std::to_string(component);
}

void addColumns(const AttributeBlock& block, FrameColumns& out) {
  std::vector<float> values;
  readFloats(block, values);
  const std::uint32_t components = block.attribute->components();
  for (std::uint32_t c = 0; c < components; ++c) {
    FrameColumns::Column column{columnName(*block.attribute, c), {}};
    column.values.reserve(values.size() / components);
    for (std::size_t i = c; i < values.size(); i += components) column.values.push_back(values[i]);
    out.columns.push_back(std::move(column));
  }
}

}  // namespace

const FrameColumns::Column* FrameColumns::find(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

::bleedsim::Status toColumns(const Frame& frame, FrameColumns& out) {
  const Result<std::vector<AttributeBlock>> blocks = layoutOf(frame);
  if (!blocks) return blocks.status();
  const AttributeBlock& positions = *findBlock(*blocks, Attribute::POSITION);
  const AttributeBlock& ids = *findBlock(*blocks, Attribute::ID);
  out.columns.clear();
  out.ids.resize(frame.count());
  if (!out.ids.empty()) std::memcpy(out.ids.data(), ids.bytes.data(), ids.bytes.size());
  addColumns(positions, out);
  for (const AttributeBlock& block : *blocks) {
    const Attribute& attribute = *block.attribute;
    // Whole numbers of a meaning that this version does not know are left out: their values could not be kept as floats.
    if (&block != &positions && attribute.scalar_type() != Attribute::UINT32) addColumns(block, out);
  }
  return {};
}

}  // namespace bleedsim::recording
