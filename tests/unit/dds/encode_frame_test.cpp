#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "service/dds/frame_encoder.h"

namespace bleedsim::dds {
namespace {

FrameSnapshot threeParticles(std::uint32_t attributes) {
  FrameSnapshot snapshot;
  snapshot.reserve(3);
  snapshot.frame.position = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  snapshot.frame.id = {70, 80, 90};
  snapshot.frame.velocity = {-1, -2, -3, -4, -5, -6, -7, -8, -9};
  snapshot.frame.density = {1000, 1001, 1002};
  snapshot.frame.viscosity = {0.1F, 0.2F, 0.3F};
  snapshot.frame.platelet = {0.97F, 0.98F, 0.99F};
  snapshot.frame.radius = {0.001F, 0.002F, 0.003F};
  snapshot.frame.count = 3;
  snapshot.frame.step = 12;
  snapshot.frame.time = 0.25;
  snapshot.frame.attributes = attributes;
  snapshot.epoch = 2;
  return snapshot;
}

template <class T>
T scalarAt(const bleed_v1_Frame& frame, std::size_t index) {
  T out;
  std::memcpy(&out, frame.payload._buffer + index * sizeof(T), sizeof(T));
  return out;
}

TEST(FrameEncoder, WritesPositionsAndIdsOneAfterTheOther) {
  FrameEncoder encoder{Uuid{9}};
  const bleed_v1_Frame& frame = encoder.encode(threeParticles(0), 5);
  EXPECT_EQ(frame.session[0], 9);
  EXPECT_EQ(frame.seq, 5U);
  EXPECT_EQ(frame.step, 12U);
  EXPECT_EQ(frame.epoch, 2U);
  EXPECT_EQ(frame.count, 3U);
  ASSERT_EQ(frame.attributes._length, 2U);
  EXPECT_EQ(frame.attributes._buffer[1].semantic, static_cast<std::uint32_t>(bleed_v1_SEMANTIC_ID));
  ASSERT_EQ(frame.payload._length, 3U * 4U * 4U);
  EXPECT_EQ(scalarAt<float>(frame, 8), 9.0F);
  EXPECT_EQ(scalarAt<std::uint32_t>(frame, 9), 70U);
}

TEST(FrameEncoder, WritesEveryAttributeAskedFor) {
  FrameEncoder encoder{Uuid{}};
  const bleed_v1_Frame& frame = encoder.encode(threeParticles(allFrameAttributes()), 1);
  ASSERT_EQ(frame.attributes._length, 7U);
  ASSERT_EQ(frame.payload._length, 3U * 11U * 4U);
  EXPECT_EQ(scalarAt<float>(frame, 12), -1.0F);
  EXPECT_EQ(scalarAt<float>(frame, 12 + 9), 1000.0F);
  EXPECT_EQ(scalarAt<float>(frame, 12 + 12 + 2), 0.3F);
  EXPECT_EQ(frame.attributes._buffer[5].semantic, static_cast<std::uint32_t>(bleed_v1_SEMANTIC_PLATELET));
  EXPECT_EQ(scalarAt<float>(frame, 12 + 15), 0.97F);
  EXPECT_EQ(frame.attributes._buffer[6].semantic, static_cast<std::uint32_t>(bleed_v1_SEMANTIC_RADIUS));
  EXPECT_EQ(scalarAt<float>(frame, 12 + 18 + 2), 0.003F);
}

TEST(FrameEncoder, BytesPerParticleAreThoseOfThePayload) {
  FrameEncoder encoder{Uuid{}};
  for (std::uint32_t attributes = 0; attributes < 8; ++attributes) {
    EXPECT_EQ(encoder.encode(threeParticles(attributes), 1).payload._length, 3 * frameBytesPerParticle(attributes)) << attributes;
  }
  EXPECT_EQ(frameBytesPerParticle(sph::kFrameVelocity), 28U);
}

TEST(FrameEncoder, ReusesItsMemory) {
  FrameEncoder encoder{Uuid{}};
  encoder.reserve(3);
  const std::uint8_t* first = encoder.encode(threeParticles(0), 1).payload._buffer;
  const std::uint8_t* second = encoder.encode(threeParticles(sph::kFrameVelocity | sph::kFrameDensity), 2).payload._buffer;
  EXPECT_EQ(first, second);
}

TEST(FrameEncoder, EncodesAnEmptyWorld) {
  FrameEncoder encoder{Uuid{}};
  FrameSnapshot empty;
  EXPECT_EQ(encoder.encode(empty, 1).payload._length, 0U);
}

TEST(FrameStatsEncoder, ConvertsAndNamesEverything) {
  FrameSnapshot snapshot = threeParticles(0);
  snapshot.stats.step = 12;
  snapshot.stats.emitted_volume = 2e-6;
  snapshot.stats.commanded_volume = 3e-6;
  snapshot.stats.counters[static_cast<std::size_t>(sph::Counter::left_domain)] = 4;
  snapshot.stats.counters[static_cast<std::size_t>(sph::Counter::infinite_force_capped)] = 2;
  snapshot.stage_microseconds[static_cast<std::size_t>(sph::Stage::density)] = 250.0;
  snapshot.wounds = {{1, 1e-6, 2e-6}};
  snapshot.instruments[0] = {Uuid{3}, 8, 900, 11};
  snapshot.instrument_count = 1;
  FrameStatsEncoder encoder{Uuid{9}};
  const std::vector<NamedCount> service{{"requests_refused", 6}};
  const bleed_v1_FrameStats& stats = encoder.encode(snapshot, 5, 7, service);
  EXPECT_EQ(stats.seq, 5U);
  EXPECT_EQ(stats.frames_overwritten, 7U);
  EXPECT_DOUBLE_EQ(stats.emitted_ml, 2.0);
  EXPECT_DOUBLE_EQ(stats.commanded_ml, 3.0);
  ASSERT_EQ(stats.wounds._length, 1U);
  EXPECT_DOUBLE_EQ(stats.wounds._buffer[0].flow_ml_per_s, 2.0);
  ASSERT_EQ(stats.stage_costs._length, static_cast<std::uint32_t>(sph::Stage::count));
  EXPECT_STREQ(stats.stage_costs._buffer[4].name, "density");
  EXPECT_DOUBLE_EQ(stats.stage_costs._buffer[4].microseconds, 250.0);
  ASSERT_EQ(stats.fault_counters._length, static_cast<std::uint32_t>(sph::Counter::count) + 1);
  EXPECT_STREQ(stats.fault_counters._buffer[stats.fault_counters._length - 1].name, "requests_refused");
  EXPECT_EQ(stats.fault_counters._buffer[static_cast<std::size_t>(sph::Counter::left_domain)].value, 4U);
  const bleed_v1_Counter& rung = stats.fault_counters._buffer[static_cast<std::size_t>(sph::Counter::infinite_force_capped)];
  EXPECT_STREQ(rung.name, "infinite_force_capped");
  EXPECT_EQ(rung.value, 2U);
  ASSERT_EQ(stats.instruments._length, 1U);
  EXPECT_EQ(stats.instruments._buffer[0].client_stamp_ns, 900);
}

}  // namespace
}  // namespace bleedsim::dds
