// The quality of service of every endpoint, in one table. Both ends take theirs from here, so they always match.
#pragma once

#include <chrono>
#include <cstdint>
#include <dds/dds.h>
#include <memory>
#include <string>

#include "service/transport/names.h"

namespace bleedsim::transport {

/// What a reader is for; topics that make no difference between them ignore it.
enum class Reading {
  live,       ///< newest wins: best effort, two samples deep on the frame topics
  reliable,   ///< every loss is repaired as long as the newest is still wanted: reliable, one deep on the frame topics
  recorder,   ///< every sample: reliable with a deep history
  discovery,  ///< partition "*", where samples of many sessions share one history
};

/// The policies that bleedsim sets; all others keep their defaults. A depth of 0 means keep-all.
struct EndpointQos {
  bool reliable = true;
  std::chrono::nanoseconds max_blocking{std::chrono::milliseconds{100}};  ///< writers: longest wait for room
  std::int32_t depth = 1;                                                 ///< samples kept, 0: all
  bool transient_local = false;                                           ///< late joiners get the writer's history
  std::int32_t durability_depth = 0;                                      ///< writers: history for late joiners, 0: not set
  std::chrono::nanoseconds liveliness_lease{0};                           ///< writers: automatic liveliness, 0: not set

  bool operator==(const EndpointQos&) const = default;
};

/// Largest depth of a frame reader: bounds its memory to about this many frames.
inline constexpr std::int32_t kMaxFrameDepth = 256;
inline constexpr std::int32_t kJournalDepth = 65536;

EndpointQos writerQos(Topic topic);
EndpointQos readerQos(Topic topic, Reading reading = Reading::live);

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPointer = std::unique_ptr<dds_qos_t, QosDeleter>;

QosPointer toDds(const EndpointQos& qos);
/// QoS of a publisher or subscriber in one partition.
QosPointer partitionQos(const std::string& partition);

}  // namespace bleedsim::transport
