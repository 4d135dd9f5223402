// bleedctl as a process of its own, against a fake service in this process.
#pragma once

#include <cstdlib>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

#include "tests/integration/client/fake_service.h"
#include "tests/support/child_process.h"

namespace bleedsim::client_test {

class BleedctlTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string tag = fmt::format("b{}", getpid());
    setenv("BLEEDSIM_DDS_TAG", tag.c_str(), 1);
    auto participant = transport::Participant::create({.domain = 66, .tag = tag});
    ASSERT_TRUE(participant.ok()) << participant.status().message();
    participant_.emplace(*participant);
  }

  std::unique_ptr<FakeService> serve(const std::string& name, FakeService::Judge judge = {}) {
    auto service = FakeService::start(*participant_, name, std::move(judge));
    EXPECT_TRUE(service.ok());
    (*service)->publishStatus();
    (*service)->publishScene("round_wound");
    return std::move(*service);
  }

  static std::vector<std::string> command(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {BLEEDCTL_PATH, "--domain", "66"});
    return arguments;
  }
  static test::Finished bleedctl(std::vector<std::string> arguments) {
    return test::runProcess(command(std::move(arguments)), true);
  }

  std::optional<transport::Participant> participant_;
};

}  // namespace bleedsim::client_test
