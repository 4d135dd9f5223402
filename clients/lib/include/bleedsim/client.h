// The entry to the client library: finds sessions and opens them.
//
//   auto client = bleedsim::client::Client::create({});
//   auto session = client->open("", {}, std::chrono::seconds{10});   // "" is the first one found
//   auto frame = session->waitFrame(std::chrono::seconds{1});
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bleedsim/session.h"
#include "bleedsim/types.h"

namespace bleedsim::client {

struct ClientOptions {
  std::uint32_t domain = 0;  ///< DDS domain, 0 to 230
  std::string interface {};  ///< network interface; empty: loopback, so that nothing leaves this host
  std::string tag{};         ///< DDS domain tag; empty: $BLEEDSIM_DDS_TAG, or none
};

/// Move-only, thread-safe. $CYCLONEDDS_URI, when set, replaces interface and tag. Sessions outlive their client.
class Client {
 public:
  /// not_found: no such interface (the message lists those there are); invalid_argument; io.
  static Result<Client> create(const ClientOptions& options);
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;
  ~Client();

  /// Sessions heard of and not gone, in the order in which they were found. Discovery takes some 0.1 s after create.
  std::vector<SessionStatus> sessions();
  /// Listens for `window` and returns the sessions.
  std::vector<SessionStatus> listSessions(std::chrono::nanoseconds window);
  /// Waits for a session of that name, or for any when the name is empty. timed_out lists those seen.
  Result<SessionStatus> find(const std::string& name, std::chrono::nanoseconds timeout);
  /// Finds and opens: when it returns, commands reach the session.
  Result<Session> open(const std::string& name, const SessionOptions& options, std::chrono::nanoseconds timeout);

 private:
  friend class Recorder;
  class Impl;
  explicit Client(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace bleedsim::client
