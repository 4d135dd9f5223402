#include "service/recording/point_cloud.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "service/recording/frame_layout.h"
#include "service/recording/schemas.h"

namespace bleedsim::recording {
namespace {

using Field = foxglove::PackedElementField;

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
constexpr std::size_t kScalar = 4;  // bytes of a float and of an id

/// Collects the columns of a cloud and writes them side by side.
class Packer {
 public:
  explicit Packer(foxglove::PointCloud& out) : out_{out} {}

  void declare(const std::string& name, Field::NumericType type) {
    Field& field = *out_.add_fields();
    field.set_name(name);
    field.set_offset(static_cast<std::uint32_t>(stride_));
    field.set_type(type);
    stride_ += kScalar;
  }
  /// After all fields are declared.
  void start(std::size_t points) {
    out_.set_point_stride(static_cast<std::uint32_t>(stride_));
    out_.mutable_data()->assign(points * stride_, '\0');
  }
  /// `components` columns of numbers of 4 bytes, from the next column on.
  void put(const char* numbers, std::size_t points, std::size_t components) {
    const std::size_t bytes = components * kScalar;
    char* data = out_.mutable_data()->data() + column_;
    for (std::size_t i = 0; i < points; ++i) std::memcpy(data + i * stride_, numbers + i * bytes, bytes);
    column_ += bytes;
  }

 private:
  foxglove::PointCloud& out_;
  std::size_t stride_ = 0;
  std::size_t column_ = 0;
};

bool isDrawn(const AttributeBlock& block) {
  const Attribute::Semantic semantic = block.attribute->semantic();
  const bool number = block.attribute->scalar_type() != Attribute::UINT32;
  return semantic != Attribute::POSITION && semantic != Attribute::ID && number;
}

void declareBlock(const AttributeBlock& block, Packer& packer) {
  const std::string name = nameOf(block.attribute->semantic());
  const std::uint32_t components = block.attribute->components();
  for (std::uint32_t c = 0; c < components; ++c) {
    const std::string part = components == kAxes.size() ? kAxes[c] : std::to_string(c);
    packer.declare(components == 1 ? name : name + "_" + part, Field::FLOAT32);
  }
  if (block.attribute->semantic() == Attribute::VELOCITY) packer.declare("speed", Field::FLOAT32);
}

void putFloats(const std::vector<float>& values, std::size_t points, std::size_t components, Packer& packer) {
  packer.put(reinterpret_cast<const char*>(values.data()), points, components);
}

}  // namespace

::bleedsim::Status toPointCloud(const Frame& frame, const std::string& frame_id, foxglove::PointCloud& out) {
  const Result<std::vector<AttributeBlock>> blocks = layoutOf(frame);
  if (!blocks) return blocks.status();
  out.Clear();
  constexpr std::int64_t kNs = 1'000'000'000;
  const std::int64_t stamp = std::max<std::int64_t>(frame.realtime_stamp_ns(), 0);
  out.mutable_timestamp()->set_seconds(stamp / kNs);
  out.mutable_timestamp()->set_nanos(static_cast<std::int32_t>(stamp % kNs));
  out.set_frame_id(frame_id.empty() ? kDefaultFrameId : frame_id);
  out.mutable_pose()->mutable_position();
  out.mutable_pose()->mutable_orientation()->set_w(1.0);

  Packer packer{out};
  for (const char* axis : kAxes) packer.declare(axis, Field::FLOAT32);
  packer.declare("id", Field::UINT32);
  for (const AttributeBlock& block : *blocks) {
    if (isDrawn(block)) declareBlock(block, packer);
  }
  const std::size_t points = frame.count();
  packer.start(points);
  std::vector<float> values;
  readFloats(*findBlock(*blocks, Attribute::POSITION), values);
  putFloats(values, points, kAxes.size(), packer);
  packer.put(findBlock(*blocks, Attribute::ID)->bytes.data(), points, 1);
  for (const AttributeBlock& block : *blocks) {
    if (!isDrawn(block)) continue;
    readFloats(block, values);
    putFloats(values, points, block.attribute->components(), packer);
    if (block.attribute->semantic() != Attribute::VELOCITY) continue;
    std::vector<float> speeds;
    vectorLengths(values, block.attribute->components(), speeds);
    putFloats(speeds, points, 1, packer);
  }
  return {};
}

mcap::Schema pointCloudSchema(std::uint16_t id) {
  const google::protobuf::Descriptor& message = *foxglove::PointCloud::descriptor();
  return {id, message.full_name(), "protobuf", descriptorSetOf(*message.file())};
}

mcap::Channel pointCloudChannel(std::uint16_t id, std::uint16_t schema_id) {
  return {id,
          schema_id,
          kPointCloudChannel,
          "protobuf",
          {{"units", "position m, velocity m/s, radius m, viscosity Pa s, density kg/m^3"}}};
}

}  // namespace bleedsim::recording
