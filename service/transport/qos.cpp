#include "service/transport/qos.h"

namespace bleedsim::transport {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::int32_t kKeepAll = 0;
constexpr std::int32_t kFrameWriterDepth = 8;
constexpr std::int32_t kRecorderFrameDepth = 128;  // two seconds at 60 Hz
constexpr std::int32_t kSmallHistory = 1024;
constexpr std::int32_t kDiscoveryDepth = 64;

EndpointQos frameReader(Reading reading, std::int32_t recorder_depth) {
  switch (reading) {
    case Reading::reliable:
      return {.reliable = true, .depth = 1};
    case Reading::recorder:
      return {.reliable = true, .depth = recorder_depth};
    case Reading::live:
    case Reading::discovery:
      break;
  }
  return {.reliable = false, .depth = 2};
}

}  // namespace

EndpointQos writerQos(Topic topic) {
  switch (topic) {
    // Keep-last: a reader that does not drain never blocks the writer, nor starves the other readers.
    case Topic::frame:
      return {.depth = kFrameWriterDepth};
    case Topic::frame_stats:
      return {.depth = kFrameWriterDepth};
    case Topic::scene:
      return {.depth = 1, .transient_local = true, .durability_depth = 1};
    case Topic::status:
      return {.depth = 1, .transient_local = true, .durability_depth = 1, .liveliness_lease = seconds{2}};
    // Keep-all: with keep-last 1 a 1 kHz stream loses 1-2 % of its samples.
    case Topic::instrument:
      return {.max_blocking = milliseconds{20}, .depth = kKeepAll};
    case Topic::request:
      return {.max_blocking = milliseconds{20}, .depth = kKeepAll};
    case Topic::reply:
      return {.max_blocking = milliseconds{0}, .depth = kSmallHistory};
    // The durability service keeps one sample by default, whatever the history says.
    case Topic::journal:
      return {.depth = kJournalDepth, .transient_local = true, .durability_depth = kJournalDepth};
  }
  return {};
}

EndpointQos readerQos(Topic topic, Reading reading) {
  const bool many = reading == Reading::discovery || reading == Reading::recorder;
  switch (topic) {
    case Topic::frame:
      return frameReader(reading, kRecorderFrameDepth);
    case Topic::frame_stats:
      return frameReader(reading, kSmallHistory);
    case Topic::scene:
      return {.depth = many ? kDiscoveryDepth : 1, .transient_local = true};
    case Topic::status:
      return {.depth = many ? kDiscoveryDepth : 1, .transient_local = true};
    case Topic::instrument:
      return {.depth = kSmallHistory};
    case Topic::request:
      // All clients share this history: a shallow one lets a burst of one push out the others' requests.
      return {.depth = 1024};
    case Topic::reply:
      return {.depth = kSmallHistory};
    case Topic::journal:
      return {.depth = kJournalDepth, .transient_local = true};
  }
  return {};
}

QosPointer toDds(const EndpointQos& qos) {
  QosPointer out{dds_create_qos()};
  dds_qset_reliability(out.get(), qos.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       qos.max_blocking.count());
  // No resource limits: a reliable reader with limits that is not drained blocks the receive path of the whole process.
  const dds_history_kind_t kind = qos.depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL;
  dds_qset_history(out.get(), kind, qos.depth > 0 ? qos.depth : 1);
  dds_qset_durability(out.get(), qos.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (qos.durability_depth > 0) {
    dds_qset_durability_service(out.get(), 0, DDS_HISTORY_KEEP_LAST, qos.durability_depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  if (qos.liveliness_lease.count() > 0) {
    dds_qset_liveliness(out.get(), DDS_LIVELINESS_AUTOMATIC, qos.liveliness_lease.count());
  }
  return out;
}

QosPointer partitionQos(const std::string& partition) {
  QosPointer out{dds_create_qos()};
  dds_qset_partition1(out.get(), partition.c_str());
  return out;
}

}  // namespace bleedsim::transport
