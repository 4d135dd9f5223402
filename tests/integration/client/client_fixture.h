// A client in this process, and a participant for the fake services that it talks to.
#pragma once

#include <chrono>
#include <cstdint>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>
#include <utility>

#include "bleedsim/client.h"
#include "tests/integration/client/fake_service.h"

namespace bleedsim::client_test {

inline constexpr std::chrono::seconds kLong{20};

class ClientFixture : public testing::Test {
 protected:
  static constexpr std::uint32_t kDomain = 65;

  void SetUp() override {
    const std::string tag = fmt::format("c{}", getpid());
    auto participant = transport::Participant::create({.domain = kDomain, .tag = tag});
    ASSERT_TRUE(participant.ok()) << participant.status().message();
    participant_.emplace(*participant);
    auto client = client::Client::create({.domain = kDomain, .tag = tag});
    ASSERT_TRUE(client.ok()) << client.status().message();
    client_.emplace(std::move(*client));
  }

  std::unique_ptr<FakeService> serve(const std::string& name, FakeService::Judge judge = {}) {
    auto service = FakeService::start(*participant_, name, std::move(judge));
    EXPECT_TRUE(service.ok());
    (*service)->publishStatus();
    return std::move(*service);
  }

  std::optional<transport::Participant> participant_;
  std::optional<client::Client> client_;
};

}  // namespace bleedsim::client_test
