// The QoS table of the design: depths, reliability and durability of every endpoint, and that both ends match.
#include "service/transport/qos.h"

#include <gtest/gtest.h>

namespace bleedsim::transport {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(WriterQos, FollowsTheTable) {
  for (const Topic topic : {Topic::frame, Topic::frame_stats}) {
    const EndpointQos qos = writerQos(topic);
    EXPECT_TRUE(qos.reliable);
    EXPECT_EQ(qos.depth, 8);
    EXPECT_FALSE(qos.transient_local);
  }
  for (const Topic topic : {Topic::scene, Topic::status}) {
    const EndpointQos qos = writerQos(topic);
    EXPECT_TRUE(qos.reliable);
    EXPECT_TRUE(qos.transient_local);
    EXPECT_EQ(qos.depth, 1);
  }
  EXPECT_EQ(writerQos(Topic::status).liveliness_lease, seconds{2});
  EXPECT_EQ(writerQos(Topic::scene).liveliness_lease, seconds{0});
  for (const Topic topic : {Topic::instrument, Topic::request}) {
    const EndpointQos qos = writerQos(topic);
    EXPECT_TRUE(qos.reliable);
    EXPECT_EQ(qos.depth, 0) << "keep-all";
    EXPECT_EQ(qos.max_blocking, milliseconds{20});
    EXPECT_FALSE(qos.transient_local);
  }
  EXPECT_TRUE(writerQos(Topic::reply).reliable);
  EXPECT_EQ(writerQos(Topic::reply).max_blocking, milliseconds{0});
  EXPECT_GT(writerQos(Topic::reply).depth, 0) << "a keep-all reply writer with blocking 0 would drop replies";
  EXPECT_EQ(writerQos(Topic::journal).depth, 65536);
  EXPECT_EQ(writerQos(Topic::journal).durability_depth, 65536);
  EXPECT_TRUE(writerQos(Topic::journal).transient_local);
}

TEST(ReaderQos, FollowsTheTable) {
  EXPECT_EQ(readerQos(Topic::frame), (EndpointQos{.reliable = false, .depth = 2}));
  EXPECT_EQ(readerQos(Topic::frame, Reading::reliable), (EndpointQos{.reliable = true, .depth = 1}));
  EXPECT_TRUE(readerQos(Topic::frame, Reading::recorder).reliable);
  EXPECT_GE(readerQos(Topic::frame, Reading::recorder).depth, 60);
  EXPECT_LE(readerQos(Topic::frame, Reading::recorder).depth, kMaxFrameDepth);
  EXPECT_EQ(readerQos(Topic::instrument).depth, 1024);
  EXPECT_EQ(readerQos(Topic::request).depth, 1024);
  EXPECT_EQ(readerQos(Topic::reply).depth, 1024);
  EXPECT_EQ(readerQos(Topic::journal).depth, 65536);
  EXPECT_TRUE(readerQos(Topic::journal).transient_local);
  EXPECT_GE(readerQos(Topic::status, Reading::discovery).depth, 64) << "one keyless history holds all sessions";
}

TEST(ReaderQos, NeverKeepsAllAndNeverAsksForMoreThanItsWriterOffers) {
  for (const Topic topic : kTopics) {
    for (const Reading reading : {Reading::live, Reading::reliable, Reading::recorder, Reading::discovery}) {
      const EndpointQos reader = readerQos(topic, reading);
      const EndpointQos writer = writerQos(topic);
      EXPECT_GT(reader.depth, 0) << topicName(topic);
      EXPECT_TRUE(writer.reliable || !reader.reliable) << topicName(topic);
      EXPECT_TRUE(writer.transient_local || !reader.transient_local) << topicName(topic);
    }
  }
}

TEST(ToDds, SetsEveryPolicy) {
  const QosPointer qos = toDds({.reliable = true,
                                .max_blocking = milliseconds{20},
                                .depth = 0,
                                .transient_local = true,
                                .durability_depth = 7,
                                .liveliness_lease = seconds{2}});
  dds_reliability_kind_t reliability{};
  dds_duration_t blocking = 0;
  ASSERT_TRUE(dds_qget_reliability(qos.get(), &reliability, &blocking));
  EXPECT_EQ(reliability, DDS_RELIABILITY_RELIABLE);
  EXPECT_EQ(blocking, 20'000'000);
  dds_history_kind_t history{};
  std::int32_t depth = 0;
  ASSERT_TRUE(dds_qget_history(qos.get(), &history, &depth));
  EXPECT_EQ(history, DDS_HISTORY_KEEP_ALL);
  dds_durability_kind_t durability{};
  ASSERT_TRUE(dds_qget_durability(qos.get(), &durability));
  EXPECT_EQ(durability, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_liveliness_kind_t liveliness{};
  dds_duration_t lease = 0;
  ASSERT_TRUE(dds_qget_liveliness(qos.get(), &liveliness, &lease));
  EXPECT_EQ(liveliness, DDS_LIVELINESS_AUTOMATIC);
  EXPECT_EQ(lease, 2'000'000'000);
  dds_history_kind_t service_kind{};
  std::int32_t service_depth = 0;
  ASSERT_TRUE(dds_qget_durability_service(qos.get(), nullptr, &service_kind, &service_depth, nullptr, nullptr, nullptr));
  EXPECT_EQ(service_depth, 7);
}

}  // namespace
}  // namespace bleedsim::transport
