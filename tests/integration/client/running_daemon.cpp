#include "tests/integration/client/running_daemon.h"

#include <csignal>
#include <cstdlib>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace bleedsim::client_test {

void isolate() {
  const std::string tag = fmt::format("t{}", getpid());
  setenv("BLEEDSIM_DDS_TAG", tag.c_str(), 1);
}

std::unique_ptr<RunningDaemon> RunningDaemon::start(const std::string& program, const std::string& scene,
                                                    const std::string& session, std::uint32_t domain,
                                                    const std::vector<std::string>& more) {
  std::vector<std::string> command{program, "--scene", scene, "--session", session, "--domain", std::to_string(domain)};
  command.insert(command.end(), more.begin(), more.end());
  std::unique_ptr<RunningDaemon> daemon{new RunningDaemon{command}};
  Result<client::Client> here = client::Client::create({.domain = domain});
  if (!here) {
    ADD_FAILURE() << here.status().message();
    return nullptr;
  }
  daemon->client_.emplace(std::move(*here));
  Result<client::Session> open = daemon->client_->open(session, {.delivery = client::Delivery::none}, test::kPatience);
  if (!open) {
    daemon->process_.signal(SIGTERM);
    daemon->process_.wait();
    ADD_FAILURE() << open.status().message() << "\n" << daemon->process_.output();
    return nullptr;
  }
  daemon->session_.emplace(std::move(*open));
  const auto runs = [](const client::SessionStatus& status) { return status.state == client::SessionState::running; };
  const Result<client::SessionStatus> running = daemon->session_->waitStatus(runs, test::kPatience);
  EXPECT_TRUE(running.ok()) << running.status().message();
  return running.ok() ? std::move(daemon) : nullptr;
}

}  // namespace bleedsim::client_test
