// WaitSet and GuardCondition: how a thread sleeps until there is something to do. Listeners are not used: they run on the
// middleware's threads.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "service/transport/participant.h"
#include "service/transport/reader.h"
#include "service/transport/writer.h"

namespace bleedsim::transport {

/// Wakes a wait set from any thread. Stays raised until `lower`.
class GuardCondition {
 public:
  static Result<GuardCondition> create(const Participant& participant);

  void raise() { dds_set_guardcondition(condition_.get(), true); }
  void lower() { dds_set_guardcondition(condition_.get(), false); }
  dds_entity_t handle() const { return condition_.get(); }

 private:
  GuardCondition(Participant participant, Entity condition)
      : participant_{std::move(participant)}, condition_{std::move(condition)} {}

  Participant participant_;
  Entity condition_;
};

/// Which of the attached things woke the wait: bit `token`.
class WakeUp {
 public:
  explicit WakeUp(std::uint64_t bits) : bits_{bits} {}
  bool has(unsigned token) const { return (bits_ >> token & 1U) != 0; }
  bool timedOut() const { return bits_ == 0; }

 private:
  std::uint64_t bits_;
};

/// Move-only; attached readers, writers and guards must outlive it or be re-attached. Tokens are 0 to 63 and may be shared.
class WaitSet {
 public:
  static Result<WaitSet> create(const Participant& participant);

  /// Wakes as long as the reader holds samples that were not taken.
  template <class T>
  Status attach(const Reader<T>& reader, unsigned token) {
    return attachSamples(reader.handle(), token);
  }
  /// Wakes as long as the guard is raised.
  Status attach(const GuardCondition& guard, unsigned token) { return attachEntity(guard.handle(), token); }

  /// Wakes when a writer appears, goes or loses its liveliness, until matchedPublications() is called. The same reader may be
  /// attached for its samples as well.
  template <class T>
  Status attachMatches(const Reader<T>& reader, unsigned token) {
    return attachStatus(reader.handle(), DDS_SUBSCRIPTION_MATCHED_STATUS | DDS_LIVELINESS_CHANGED_STATUS, token);
  }
  /// Wakes when a reader appears or goes, until matchedCount() is called.
  template <class T>
  Status attachMatches(const Writer<T>& writer, unsigned token) {
    return attachStatus(writer.handle(), DDS_PUBLICATION_MATCHED_STATUS, token);
  }

  /// Negative time-outs wait for ever.
  Result<WakeUp> wait(std::chrono::nanoseconds timeout);

 private:
  WaitSet(Participant participant, Entity wait_set) : participant_{std::move(participant)}, wait_set_{std::move(wait_set)} {}
  Status attachSamples(dds_entity_t reader, unsigned token);
  Status attachStatus(dds_entity_t entity, std::uint32_t mask, unsigned token);
  Status attachEntity(dds_entity_t entity, unsigned token);

  Participant participant_;
  Entity wait_set_;
  std::vector<Entity> conditions_;
};

}  // namespace bleedsim::transport
