// Writer<T>: a typed DDS writer in one session's partition.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "service/transport/participant.h"
#include "service/transport/topic_traits.h"

namespace bleedsim::transport {

/// Move-only. `write` may be called from one thread at a time.
template <class T>
class Writer {
 public:
  static Result<Writer> create(const Participant& participant, const std::string& session,
                               const EndpointQos& qos = writerQos(TopicTraits<T>::kTopic)) {
    if (Status name = checkSessionName(session); !name) return name;
    auto made = participant.createWriter(TopicTraits<T>::kTopic, TopicTraits<T>::descriptor(), session, qos);
    if (!made) return made.status();
    return Writer{std::move(*made)};
  }

  /// timed_out: no room within the topic's blocking time, the sample is not sent.
  Status write(const T& sample) {
    const dds_return_t code = dds_write(handle(), &sample);
    if (code < 0) [[unlikely]]
      return ddsStatus(code, topicName(TopicTraits<T>::kTopic));
    return {};
  }

  /// Matching readers now; writing without any may be skipped on volatile topics. Clears the matched status of a wait set.
  std::size_t matchedCount() const {
    dds_publication_matched_status_t status{};
    return dds_get_publication_matched_status(handle(), &status) == DDS_RETCODE_OK ? status.current_count : 0;
  }

  /// Waits until all matched reliable readers have acknowledged everything; timed_out otherwise.
  Status waitForAcknowledgements(std::chrono::nanoseconds timeout) {
    return ddsStatus(dds_wait_for_acks(handle(), timeout.count()), "get everything acknowledged");
  }

  dds_entity_t handle() const { return endpoint_.entity.get(); }

 private:
  explicit Writer(Participant::Endpoint endpoint) : endpoint_{std::move(endpoint)} {}

  Participant::Endpoint endpoint_;
};

}  // namespace bleedsim::transport
