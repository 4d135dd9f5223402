// The memory of answered requests: the same request sent again gets its first reply and is not carried out again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <optional>

#include "service/dds/reply.h"

namespace bleedsim::daemon {

/// Bounded: the last kRequests of each of kClients client starts. When one more comes, the sender that has most of them loses the
/// one that was heard of longest ago: whoever makes up starts pushes out his own. Of a start that was forgotten, a request sent
/// again counts as new. Safe from any thread.
class ReplyCache {
 public:
  static constexpr std::size_t kRequests = 1024;
  static constexpr std::size_t kClients = 256;

  enum class Known {
    fresh,     ///< carry it out; it is marked as in work now
    in_work,   ///< its reply will come
    answered,  ///< send the first reply again
    stale,     ///< older than what is kept
  };
  struct Answer {
    Known known = Known::fresh;
    std::optional<dds::Reply> reply;  ///< when answered
    std::uint64_t missed = 0;         ///< numbers left out since the highest one before
  };

  /// `sender`: who sends for this client, see CommandQueue.
  Answer begin(const dds::RequestKey& key, std::uint64_t sender);
  /// Remembers how a request ended.
  void finish(const dds::Reply& reply);
  /// Makes a request fresh again: it was refused for a moment only.
  void forget(const dds::RequestKey& key);

  std::size_t clientCount() const;

 private:
  struct Client {
    dds::ClientRun origin;
    std::uint64_t sender = 0;
    std::uint64_t highest = 0;                                    // sequence number, 0: none yet
    std::map<std::uint64_t, std::optional<dds::Reply>> requests;  // no reply: in work
    std::uint64_t dropped_through = 0;                            // highest sequence number that was dropped, 0: none
  };
  using Clients = std::list<Client>;  // heard of last comes first

  Client& find(const dds::ClientRun& origin, std::uint64_t sender);
  void forgetOne();

  mutable std::mutex mutex_;
  Clients clients_;
  std::map<dds::ClientRun, Clients::iterator> places_;
  std::map<std::uint64_t, std::size_t> starts_;  // how many each sender has
};

}  // namespace bleedsim::daemon
