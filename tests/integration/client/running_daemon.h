// A bleedd in a process of its own that this test's domain and tag belong to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bleedsim/client.h"
#include "tests/support/child_process.h"

namespace bleedsim::client_test {

/// Puts this process and its children under a DDS tag of their own, so that tests side by side do not meet.
void isolate();

class RunningDaemon {
 public:
  /// Starts `program` on the scene, with `more` arguments, and waits until its session runs. Null: it did not; the test has
  /// failed.
  static std::unique_ptr<RunningDaemon> start(const std::string& program, const std::string& scene, const std::string& session,
                                              std::uint32_t domain, const std::vector<std::string>& more = {});

  /// The session as a client of this process sees it.
  client::Session& session() { return *session_; }
  client::Client& client() { return *client_; }
  test::ChildProcess& process() { return process_; }

 private:
  explicit RunningDaemon(const std::vector<std::string>& command) : process_{command, true} {}

  test::ChildProcess process_;
  std::optional<client::Client> client_;
  std::optional<client::Session> session_;
};

}  // namespace bleedsim::client_test
