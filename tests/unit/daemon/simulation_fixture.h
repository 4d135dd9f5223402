// A simulation of a fake world under a clock that the test moves.
#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/daemon/simulation.h"
#include "tests/unit/daemon/fake_world.h"

namespace bleedsim::daemon {

class SimulationTest : public testing::Test {
 protected:
  void start(SimulationOptions options = {{dds::PaceMode::maximum, 1.0}, {}, {}}) {
    simulation_ = std::make_unique<Simulation>(options, fakeScene("first", log_), fakeFactory(log_), channels_, now_);
  }

  /// Ticks once; the reply of the request that was pushed before, if there is one.
  Simulation::Next tick() { return simulation_->tick(now_); }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  void push(dds::Action action, const std::string& wound_name = {}) { pushAs(1, std::move(action), wound_name); }
  /// Of the client with that uuid and writer.
  void pushAs(std::uint8_t client, dds::Action action, const std::string& wound_name = {}) {
    dds::DecodedRequest request;
    request.key = {{dds::Uuid{client}, 1}, ++seq_};
    request.action = std::move(action);
    request.wound_name = wound_name;
    request.writer = client;
    request.sender = client;
    bleed_v1_Request original{};
    original.seq = seq_;
    request.original = std::make_unique<dds::RequestCopy>(original);
    ASSERT_TRUE(channels_.commands.tryPush(std::move(request)));
  }
  /// Pushes, ticks, and gives back the answer.
  dds::Reply ask(dds::Action action) {
    push(std::move(action));
    tick();
    return reply();
  }
  dds::Reply askAs(std::uint8_t client, dds::Action action) {
    pushAs(client, std::move(action));
    tick();
    return reply();
  }
  dds::Reply reply() {
    dds::Reply out;
    EXPECT_TRUE(channels_.replies.tryPop(out)) << "no reply to request " << seq_;
    return out;
  }
  void loadUntilDone() {
    while (simulation_->state() == dds::SessionState::loading) {
      channels_.commands.wakeup().wait({});
      tick();
    }
  }

  std::vector<dds::JournalEntry> journal() {
    std::vector<dds::JournalEntry> out;
    for (dds::JournalEntry entry; channels_.journal.tryPop(entry);) out.push_back(std::move(entry));
    return out;
  }

  InstrumentInput sample(std::uint64_t number, std::uint64_t writer = 5, std::uint32_t tool = 0) {
    InstrumentInput input;
    input.sample.key = {dds::Uuid{9}, tool};
    input.sample.seq = number;
    input.sample.client_stamp_ns = static_cast<std::int64_t>(number);
    input.sample.radius = 0.01;
    input.sample.force = {0.0, 0.0, static_cast<double>(number)};
    input.sample.writer = writer;
    input.sample.sender = writer;
    input.received = now_;
    return input;
  }

  TimePoint now_{std::chrono::seconds{100}};
  std::shared_ptr<FakeLog> log_ = std::make_shared<FakeLog>();
  Channels channels_;
  std::unique_ptr<Simulation> simulation_;
  std::uint64_t seq_ = 0;
};

}  // namespace bleedsim::daemon
