// A participant: a process's presence in a DDS domain, the parent of its readers and writers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "service/status/status.h"
#include "service/transport/domain.h"
#include "service/transport/entity.h"
#include "service/transport/names.h"
#include "service/transport/qos.h"

namespace bleedsim::transport {

/// Default: domain 0, loopback only. See DomainOptions and joinDomain for $CYCLONEDDS_URI.
using ParticipantOptions = DomainOptions;

/// Cheap to copy: copies share one DDS participant, which lives as long as any copy, reader, writer, wait set or guard of it.
class Participant {
 public:
  /// invalid_argument: domain or tag; not_found or unavailable: interface; io: DDS's own refusal.
  static Result<Participant> create(const ParticipantOptions& options);

  dds_entity_t handle() const { return core_->participant.get(); }

  struct Endpoint;
  /// For Writer<T> and Reader<T>, which give the descriptor of their type.
  Result<Endpoint> createWriter(Topic topic, const dds_topic_descriptor_t* descriptor, const std::string& partition,
                                const EndpointQos& qos) const;
  Result<Endpoint> createReader(Topic topic, const dds_topic_descriptor_t* descriptor, const std::string& partition,
                                const EndpointQos& qos) const;

 private:
  struct Core {
    std::shared_ptr<DomainShare> domain;  // first: outlives the participant
    Entity participant;
    std::mutex mutex;
    std::array<dds_entity_t, std::size(kTopics)> topics{};  // deleted with the participant
  };

  explicit Participant(std::shared_ptr<Core> core) : core_{std::move(core)} {}
  Result<dds_entity_t> topicEntity(Topic topic, const dds_topic_descriptor_t* descriptor) const;

  std::shared_ptr<Core> core_;
};

/// A reader or writer with the publisher or subscriber that holds its partition. Members are deleted in reverse order.
struct Participant::Endpoint {
  Participant participant;
  Entity group;
  Entity entity;
};

}  // namespace bleedsim::transport
