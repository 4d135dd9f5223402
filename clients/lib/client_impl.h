// The inside of a Client: the participant and what it has heard of sessions.
#pragma once

#include <mutex>
#include <vector>

#include "bleedsim/client.h"
#include "service/transport/reader.h"
#include "service/transport/wait_set.h"

namespace bleedsim::client {

class Client::Impl {
 public:
  static Result<std::unique_ptr<Impl>> create(const ClientOptions& options);

  std::vector<SessionStatus> sessions();
  std::vector<SessionStatus> listSessions(std::chrono::nanoseconds window);
  Result<SessionStatus> find(const std::string& name, std::chrono::nanoseconds timeout);
  const transport::Participant& participant() const { return participant_; }

 private:
  static constexpr std::size_t kMaxSessions = 256;
  struct Seen {
    SessionStatus status;
    transport::PublicationHandle publication = 0;
  };

  Impl(transport::Participant participant, transport::Reader<bleed_v1_Status> reader, transport::WaitSet waits)
      : participant_{std::move(participant)}, reader_{std::move(reader)}, waits_{std::move(waits)} {}
  void takeStatus();
  void wait(std::int64_t left_ns);

  transport::Participant participant_;
  transport::Reader<bleed_v1_Status> reader_;
  transport::WaitSet waits_;
  std::mutex wait_mutex_;  // one thread waits at a time
  std::mutex mutex_;       // covers reader_'s takes and seen_
  std::vector<Seen> seen_;
};

}  // namespace bleedsim::client
