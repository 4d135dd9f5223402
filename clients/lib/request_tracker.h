// Requests under way: numbers them, says when to send each again, matches replies and ends what gets none. No DDS and no clock in
// here; the session gives the time. Not synchronised.
#pragma once

#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bleedsim/commands.h"
#include "idl/bleed.h"

namespace bleedsim::client {

/// A request with the memory that its body points to.
struct OwnedRequest {
  bleed_v1_Request wire{};
  std::string text;
  std::vector<double> outline;

  OwnedRequest() = default;
  OwnedRequest(const OwnedRequest&) = delete;  // wire points into text and outline
  OwnedRequest& operator=(const OwnedRequest&) = delete;
};
using RequestPointer = std::shared_ptr<OwnedRequest>;

class RequestTracker {
 public:
  static constexpr std::size_t kMaxPending = 1024;  // the service keeps as many replies per client
  static constexpr std::int64_t kFirstResendNs = 250'000'000;
  static constexpr std::int64_t kLongestResendNs = 2'000'000'000;

  RequestTracker(const Uuid& client, std::uint64_t run) : client_{client}, run_{run} {}

  /// Numbers the request and makes it due at once. With kMaxPending under way the future holds ReplyCode::not_sent.
  std::future<Reply> add(const RequestPointer& request, std::int64_t now_ns, std::int64_t timeout_ns);

  /// Requests to send now, in order; each is due again after 250 ms, then twice as long up to 2 s.
  std::vector<RequestPointer> due(std::int64_t now_ns);

  /// False when the reply belongs to no request under way: another client's, an older run's or one answered before.
  bool resolve(const Uuid& client, std::uint64_t run, std::uint64_t seq, Reply reply);

  /// Ends requests whose time ran out with ReplyCode::no_answer.
  void expire(std::int64_t now_ns);
  /// Ends all with ReplyCode::no_answer.
  void endAll(const std::string& reason);

  /// When due() or expire() has something to do next; INT64_MAX: never.
  std::int64_t nextEvent() const;
  std::size_t pending() const { return pending_.size(); }

 private:
  struct Pending {
    RequestPointer request;
    std::promise<Reply> answer;
    std::int64_t next_send_ns = 0;
    std::int64_t interval_ns = kFirstResendNs;
    std::int64_t deadline_ns = 0;
  };

  Uuid client_;
  std::uint64_t run_;
  std::uint64_t next_seq_ = 1;
  std::map<std::uint64_t, Pending> pending_;
};

}  // namespace bleedsim::client
