#include "clients/lib/frame_decoder.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace bleedsim::client {
namespace {

/// A wire frame over memory of its own.
struct WireFrame {
  std::vector<bleed_v1_Attribute> attributes{{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F},
                                             {bleed_v1_SEMANTIC_ID, bleed_v1_SCALAR_UINT32, 1, 1.0F, 0.0F}};
  std::vector<std::uint8_t> payload;
  bleed_v1_Frame frame{};

  template <class T>
  WireFrame& append(std::initializer_list<T> values) {
    for (const T value : values) {
      const std::size_t at = payload.size();
      payload.resize(at + sizeof value);
      std::memcpy(payload.data() + at, &value, sizeof value);
    }
    return *this;
  }
  Status decode(Frame& into) {
    frame.attributes._buffer = attributes.data();
    frame.attributes._length = frame.attributes._maximum = static_cast<std::uint32_t>(attributes.size());
    frame.payload._buffer = payload.data();
    frame.payload._length = frame.payload._maximum = static_cast<std::uint32_t>(payload.size());
    return FrameDecoder::decode(frame, into);
  }
};

WireFrame twoParticles() {
  WireFrame wire;
  wire.frame.count = 2;
  wire.frame.seq = 9;
  wire.append({1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}).append<std::uint32_t>({70, 71});
  return wire;
}

TEST(FrameDecoder, UnpacksPositionsAndIds) {
  WireFrame wire = twoParticles();
  wire.frame.sim_time_s = 0.5;
  wire.frame.session[0] = 42;
  Frame frame;
  ASSERT_TRUE(wire.decode(frame).ok());
  EXPECT_EQ(frame.count(), 2U);
  EXPECT_EQ(frame.header().seq, 9U);
  EXPECT_EQ(frame.header().sim_time_s, 0.5);
  EXPECT_EQ(frame.header().session[0], 42);
  EXPECT_EQ(frame.positions()[5], 6.0F);
  EXPECT_EQ(frame.ids()[1], 71U);
  EXPECT_TRUE(frame.velocities().empty());
}

TEST(FrameDecoder, UnpacksPlateletsAndRadii) {
  WireFrame wire = twoParticles();
  wire.attributes.push_back({bleed_v1_SEMANTIC_PLATELET, bleed_v1_SCALAR_FLOAT32, 1, 1.0F, 0.0F});
  wire.attributes.push_back({bleed_v1_SEMANTIC_RADIUS, bleed_v1_SCALAR_FLOAT32, 1, 1.0F, 0.0F});
  wire.append({0.99F, 0.5F, 0.004F, 0.005F});
  Frame frame;
  ASSERT_TRUE(wire.decode(frame).ok());
  ASSERT_EQ(frame.platelets().size(), 2U);
  EXPECT_EQ(frame.platelets()[1], 0.5F);
  ASSERT_EQ(frame.radii().size(), 2U);
  EXPECT_EQ(frame.radii()[0], 0.004F);
}

TEST(FrameDecoder, ScalesSixteenBitValues) {
  WireFrame wire = twoParticles();
  wire.attributes.push_back({bleed_v1_SEMANTIC_DENSITY, bleed_v1_SCALAR_UINT16, 1, 0.5F, 1000.0F});
  wire.append<std::uint16_t>({0, 65535});
  Frame frame;
  ASSERT_TRUE(wire.decode(frame).ok());
  EXPECT_EQ(frame.densities()[0], 1000.0F);
  EXPECT_EQ(frame.densities()[1], 33767.5F);
}

TEST(FrameDecoder, SkipsAttributesOfNewerServices) {
  WireFrame wire = twoParticles();
  wire.attributes.insert(wire.attributes.begin(), {99, bleed_v1_SCALAR_UINT16, 2, 1.0F, 0.0F});
  std::vector<std::uint8_t> unknown(8, 0xff);
  wire.payload.insert(wire.payload.begin(), unknown.begin(), unknown.end());
  Frame frame;
  ASSERT_TRUE(wire.decode(frame).ok());
  EXPECT_EQ(frame.positions()[0], 1.0F);
}

TEST(FrameDecoder, AcceptsAnEmptyFrame) {
  WireFrame wire;
  Frame frame;
  EXPECT_TRUE(wire.decode(frame).ok());
  EXPECT_EQ(frame.positions().size(), 0U);
}

TEST(FrameDecoder, ReplacesWhatTheFrameHeldBefore) {
  WireFrame with = twoParticles();
  with.attributes.push_back({bleed_v1_SEMANTIC_RADIUS, bleed_v1_SCALAR_FLOAT32, 1, 1.0F, 0.0F});
  with.append({0.1F, 0.2F});
  Frame frame;
  ASSERT_TRUE(with.decode(frame).ok());
  EXPECT_EQ(frame.radii().size(), 2U);
  ASSERT_TRUE(twoParticles().decode(frame).ok());
  EXPECT_TRUE(frame.radii().empty());
}

TEST(FrameDecoder, RefusesEveryLengthThatDoesNotFit) {
  Frame frame;
  for (const int change : {-33, -32, -1, 1, 4, 1000}) {
    WireFrame wire = twoParticles();
    wire.payload.resize(wire.payload.size() + static_cast<std::size_t>(std::max(change, -32)));
    if (change == -33) wire.frame.count = 1;
    EXPECT_EQ(wire.decode(frame).code(), StatusCode::data_loss) << change;
  }
  WireFrame huge = twoParticles();
  huge.frame.count = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(huge.decode(frame).code(), StatusCode::data_loss);
  // 2^30 particles x 16 bytes is 0 in 34 bits and in 32: the size must not wrap.
  WireFrame wrapped;
  wrapped.frame.count = 1U << 30U;
  EXPECT_EQ(wrapped.decode(frame).code(), StatusCode::data_loss);
}

TEST(FrameDecoder, RefusesBadAttributeLists) {
  Frame frame;
  const auto refused = [&](auto&& change) {
    WireFrame wire = twoParticles();
    change(wire.attributes);
    return wire.decode(frame).code() == StatusCode::data_loss;
  };
  using List = std::vector<bleed_v1_Attribute>;
  EXPECT_TRUE(refused([](List& list) { list[0].scalar_type = 3; }));
  EXPECT_TRUE(refused([](List& list) { list[0].scalar_type = bleed_v1_SCALAR_UINT32; }));
  EXPECT_TRUE(refused([](List& list) { list[1].scalar_type = bleed_v1_SCALAR_FLOAT32; }));
  EXPECT_TRUE(refused([](List& list) { list[0].components = 0; }));
  EXPECT_TRUE(refused([](List& list) { list[0].components = 255; }));
  EXPECT_TRUE(refused([](List& list) { std::swap(list[0].components, list[1].components); }));
  EXPECT_TRUE(refused([](List& list) { list[1] = list[0]; }));
  EXPECT_TRUE(refused([](List& list) { list.pop_back(); }));
  EXPECT_TRUE(refused([](List& list) { list.clear(); }));
  EXPECT_TRUE(refused([](List& list) { list[0].scale = std::numeric_limits<float>::infinity(); }));
}

TEST(FrameDecoder, RefusesPositionsThatAreNotFinite) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    WireFrame wire;
    wire.frame.count = 1;
    wire.append({0.0F, bad, 0.0F}).append<std::uint32_t>({1});
    Frame frame;
    EXPECT_EQ(wire.decode(frame).code(), StatusCode::data_loss);
  }
}

}  // namespace
}  // namespace bleedsim::client
