#include "service/transport/participant.h"

#include <fmt/core.h>

namespace bleedsim::transport {

Result<Participant> Participant::create(const ParticipantOptions& options) {
  Result<std::shared_ptr<DomainShare>> domain = joinDomain(options);
  if (!domain) return domain.status();
  Result<Entity> participant =
      Entity::adopt(dds_create_participant(options.domain, nullptr, nullptr),
                    fmt::format("join DDS domain {}: see whether CYCLONEDDS_URI names a wrong configuration; "
                                "otherwise a hundred programs of this host are on the domain already, "
                                "so end some or choose another",
                                options.domain));
  if (!participant) return participant.status();
  auto core = std::make_shared<Core>();
  core->domain = std::move(*domain);
  core->participant = std::move(*participant);
  return Participant{std::move(core)};
}

Result<dds_entity_t> Participant::topicEntity(Topic topic, const dds_topic_descriptor_t* descriptor) const {
  const std::lock_guard lock{core_->mutex};
  dds_entity_t& known = core_->topics[static_cast<std::size_t>(topic)];
  if (known > 0) return known;
  const dds_entity_t created = dds_create_topic(handle(), descriptor, topicName(topic), nullptr, nullptr);
  if (created < 0) return ddsStatus(created, fmt::format("create topic {}", topicName(topic)));
  known = created;
  return created;
}

Result<Participant::Endpoint> Participant::createWriter(Topic topic, const dds_topic_descriptor_t* descriptor,
                                                        const std::string& partition, const EndpointQos& qos) const {
  const Result<dds_entity_t> topic_entity = topicEntity(topic, descriptor);
  if (!topic_entity) return topic_entity.status();
  Result<Entity> group = Entity::adopt(dds_create_publisher(handle(), partitionQos(partition).get(), nullptr),
                                       fmt::format("publish in session '{}'", partition));
  if (!group) return group.status();
  Result<Entity> entity = Entity::adopt(dds_create_writer(group->get(), *topic_entity, toDds(qos).get(), nullptr),
                                        fmt::format("write topic {}", topicName(topic)));
  if (!entity) return entity.status();
  return Endpoint{*this, std::move(*group), std::move(*entity)};
}

Result<Participant::Endpoint> Participant::createReader(Topic topic, const dds_topic_descriptor_t* descriptor,
                                                        const std::string& partition, const EndpointQos& qos) const {
  const Result<dds_entity_t> topic_entity = topicEntity(topic, descriptor);
  if (!topic_entity) return topic_entity.status();
  Result<Entity> group = Entity::adopt(dds_create_subscriber(handle(), partitionQos(partition).get(), nullptr),
                                       fmt::format("subscribe to session '{}'", partition));
  if (!group) return group.status();
  Result<Entity> entity = Entity::adopt(dds_create_reader(group->get(), *topic_entity, toDds(qos).get(), nullptr),
                                        fmt::format("read topic {}", topicName(topic)));
  if (!entity) return entity.status();
  return Endpoint{*this, std::move(*group), std::move(*entity)};
}

}  // namespace bleedsim::transport
