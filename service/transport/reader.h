// Reader<T>: a typed DDS reader in one session's partition.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "service/transport/participant.h"
#include "service/transport/topic_traits.h"

namespace bleedsim::transport {

/// Names one writer, for as long as it is matched.
using PublicationHandle = std::uint64_t;

/// One taken sample. `data` is lent: valid during the call only, null when the sample just tells a change of state.
template <class T>
struct Sample {
  const T* data = nullptr;
  PublicationHandle publication = 0;
  std::int64_t source_stamp_ns = 0;  ///< CLOCK_REALTIME of the writer
  bool writers_left = true;          ///< false: the last writer of the topic is gone
};

/// Move-only. One thread takes at a time.
template <class T>
class Reader {
 public:
  /// `session` is a name, or kAnySession for discovery.
  static Result<Reader> create(const Participant& participant, const std::string& session,
                               const EndpointQos& qos = readerQos(TopicTraits<T>::kTopic)) {
    if (session != kAnySession) {
      if (Status name = checkSessionName(session); !name) return name;
    }
    auto made = participant.createReader(TopicTraits<T>::kTopic, TopicTraits<T>::descriptor(), session, qos);
    if (!made) return made.status();
    return Reader{std::move(*made)};
  }

  static constexpr std::size_t kMaxBatch = 64;

  /// Takes up to `limit` (at most kMaxBatch) samples and calls use(const Sample<T>&) for each, oldest first, without copying.
  /// Returns how many there were. Call again until it returns 0 to drain the reader.
  template <class Use>
  Result<std::size_t> take(Use&& use, std::size_t limit = kMaxBatch) {
    std::array<void*, kMaxBatch> buffers{};  // null: DDS lends its own
    std::array<dds_sample_info_t, kMaxBatch> infos;
    const std::size_t wanted = std::clamp<std::size_t>(limit, 1, kMaxBatch);
    const dds_return_t taken = dds_take(handle(), buffers.data(), infos.data(), wanted, static_cast<std::uint32_t>(wanted));
    if (taken < 0) return ddsStatus(taken, topicName(TopicTraits<T>::kTopic));
    for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
      const dds_sample_info_t& info = infos[i];
      use(Sample<T>{info.valid_data ? static_cast<const T*>(buffers[i]) : nullptr, info.publication_handle, info.source_timestamp,
                    info.instance_state == DDS_IST_ALIVE});
    }
    if (taken > 0) dds_return_loan(handle(), buffers.data(), taken);
    return static_cast<std::size_t>(taken);
  }

  /// Samples that the middleware knows to be lost, since creation: what a live reader was too slow for.
  std::uint64_t lostCount() const {
    dds_sample_lost_status_t status{};
    return dds_get_sample_lost_status(handle(), &status) == DDS_RETCODE_OK ? status.total_count : 0;
  }

  /// Matching writers now. Clears the matched status of a wait set.
  std::size_t matchedCount() const {
    dds_subscription_matched_status_t status{};
    return dds_get_subscription_matched_status(handle(), &status) == DDS_RETCODE_OK ? status.current_count : 0;
  }

  /// Matching writers that hold their liveliness. Clears the matched and liveliness status of a wait set.
  std::size_t aliveCount() const {
    dds_liveliness_changed_status_t liveliness{};
    matchedCount();
    return dds_get_liveliness_changed_status(handle(), &liveliness) == DDS_RETCODE_OK ? liveliness.alive_count : 0;
  }

  /// Matching writers; a handle that is missing here is gone. That of a killed process stays for the lease of 3 s. Clears the
  /// matched and liveliness status of a wait set.
  std::vector<PublicationHandle> matchedPublications() const {
    aliveCount();
    std::vector<PublicationHandle> out(matchedCount() + 16);
    const dds_return_t count = dds_get_matched_publications(handle(), out.data(), out.size());
    out.resize(count < 0 ? 0 : std::min(out.size(), static_cast<std::size_t>(count)));
    return out;
  }

  /// The participant, usually a process, that a matching writer belongs to; 0: the writer is gone.
  std::uint64_t participantOf(PublicationHandle writer) const {
    dds_builtintopic_endpoint_t* const found = dds_get_matched_publication_data(handle(), writer);
    if (found == nullptr) return 0;
    const std::uint64_t participant = found->participant_instance_handle;
    dds_builtintopic_free_endpoint(found);
    return participant;
  }

  dds_entity_t handle() const { return endpoint_.entity.get(); }

 private:
  explicit Reader(Participant::Endpoint endpoint) : endpoint_{std::move(endpoint)} {}

  Participant::Endpoint endpoint_;
};

}  // namespace bleedsim::transport
