#include "service/transport/wait_set.h"

#include <array>

namespace bleedsim::transport {
namespace {

constexpr std::size_t kMaxAttached = 64;

}  // namespace

Result<GuardCondition> GuardCondition::create(const Participant& participant) {
  Result<Entity> made = Entity::adopt(dds_create_guardcondition(participant.handle()), "create a guard condition");
  if (!made) return made.status();
  return GuardCondition{participant, std::move(*made)};
}

Result<WaitSet> WaitSet::create(const Participant& participant) {
  Result<Entity> made = Entity::adopt(dds_create_waitset(participant.handle()), "create a wait set");
  if (!made) return made.status();
  return WaitSet{participant, std::move(*made)};
}

Status WaitSet::attachSamples(dds_entity_t reader, unsigned token) {
  // A read condition holds as long as there are samples; the reader's own status would be lost if a take came in between.
  Result<Entity> condition = Entity::adopt(dds_create_readcondition(reader, DDS_ANY_STATE), "watch a reader");
  if (!condition) return condition.status();
  conditions_.push_back(std::move(*condition));
  return attachEntity(conditions_.back().get(), token);
}

Status WaitSet::attachStatus(dds_entity_t entity, std::uint32_t mask, unsigned token) {
  if (Status enabled = ddsStatus(dds_set_status_mask(entity, mask), "watch an endpoint"); !enabled) return enabled;
  return attachEntity(entity, token);
}

Status WaitSet::attachEntity(dds_entity_t entity, unsigned token) {
  if (token >= 64) return {StatusCode::invalid_argument, "tokens of a wait set are 0 to 63"};
  return ddsStatus(dds_waitset_attach(wait_set_.get(), entity, static_cast<dds_attach_t>(token)), "attach to a wait set");
}

Result<WakeUp> WaitSet::wait(std::chrono::nanoseconds timeout) {
  std::array<dds_attach_t, kMaxAttached> woken{};
  const dds_duration_t duration = timeout.count() < 0 ? DDS_INFINITY : timeout.count();
  const dds_return_t count = dds_waitset_wait(wait_set_.get(), woken.data(), woken.size(), duration);
  if (count < 0) return ddsStatus(count, "wait");
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < std::min(woken.size(), static_cast<std::size_t>(count)); ++i) {
    bits |= std::uint64_t{1} << static_cast<unsigned>(woken[i]);
  }
  return WakeUp{bits};
}

}  // namespace bleedsim::transport
