// The other end of a session in the test's own process: it hears everything and asks with raw samples, bad ones included.
#pragma once

#include <functional>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "service/transport/clock.h"
#include "service/transport/uuid.h"
#include "service/transport/wait_set.h"
#include "tests/support/child_process.h"

namespace bleedsim::service_test {

using transport::Reading;

/// Domains 40 to 59, one for each number: tests that run side by side do not hear each other, also because of the tag.
class ServiceTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Starts bleedd on the small scene of these tests; `more` are further arguments.
  std::vector<std::string> daemonCommand(const std::string& session, const std::vector<std::string>& more = {}) const;
  std::string sceneFile() const { return scene_file_; }
  std::uint32_t domain() const { return domain_; }

  std::uint32_t domain_ = 0;
  std::string scene_file_;
};

/// Text of the small scene: a wound in flat tissue at 1000 steps a second or so.
std::string smallScene(double instrument_expiry_s = 0.1);

struct FrameHead {
  transport::Uuid session{};
  std::uint64_t seq = 0;
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::uint32_t count = 0;
  std::size_t payload = 0;
};
struct StatsHead {
  std::uint64_t seq = 0;
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::uint64_t state_hash = 0;
  std::size_t wounds = 0;
  std::size_t instruments = 0;
  std::uint64_t overwritten = 0;
  double kinetic_energy = 0.0;
};
struct SceneHead {
  std::string name;
  std::uint32_t epoch = 0;
  std::string text;
  std::string loaded_text;
  std::vector<std::string> effects;
  std::vector<std::string> known_effects;
};
struct StatusHead {
  transport::Uuid session{};
  std::string name;
  std::uint32_t state = 0;
  std::uint64_t step = 0;
  std::uint64_t heartbeat = 0;
  std::int32_t pid = 0;
  std::vector<std::pair<std::string, std::uint64_t>> counters;
  std::string text;

  std::vector<bleed_v1_ClientActivity> clients;
  transport::Uuid lease_client{};

  std::uint64_t counter(const std::string& counter_name) const;
  /// All zeros if the session has not heard of it.
  bleed_v1_ClientActivity activityOf(const transport::Uuid& client) const;
};

class Probe {
 public:
  Probe(std::uint32_t domain, const std::string& session, Reading frames = Reading::recorder);

  using Body = std::function<void(bleed_v1_RequestBody&)>;
  /// A body of that case; `fill` may set its members.
  static bleed_v1_RequestBody body(std::uint32_t kind, const Body& fill = {});
  /// A pace of `factor` times real time.
  static bleed_v1_RequestBody pace(double factor) {
    return body(bleed_v1_REQUEST_PACE, [factor](auto& request) { request._u.pace = {bleed_v1_PACE_FACTOR, factor}; });
  }

  /// Sends until there is an answer; every sending is the same request. Fails the test when none comes.
  bleed_v1_Reply ask(const bleed_v1_RequestBody& body);
  bleed_v1_Reply askAs(std::uint64_t seq, const bleed_v1_RequestBody& body);
  bleed_v1_Reply ask(std::uint32_t kind, const Body& fill = {}) { return ask(body(kind, fill)); }

  /// Sends once and does not wait for the answer; false: the middleware took it not in time.
  bool send(const bleed_v1_RequestBody& body);
  const transport::Uuid& client() const { return client_; }
  /// From now on it passes for the other one, started again.
  void impersonate(const Probe& other) { client_ = other.client_; }

  /// A good sample, unless `spoil` makes it a bad one.
  void sendInstrument(std::uint64_t seq, const std::function<void(bleed_v1_Instrument&)>& spoil = {}) {
    EXPECT_TRUE(trySendInstrument(seq, spoil));
  }
  /// False: the middleware took it not in time.
  bool trySendInstrument(std::uint64_t seq, const std::function<void(bleed_v1_Instrument&)>& spoil = {});
  /// Waits until the session reads instruments: nothing that is sent then is lost.
  void matchInstruments();
  void dropInstrumentWriter() { instruments_.reset(); }

  /// Waits for one that fits; fails the test when none comes.
  FrameHead frame(const std::function<bool(const FrameHead&)>& fits = {});
  StatsHead stats(const std::function<bool(const StatsHead&)>& fits = {});
  StatusHead status(const std::function<bool(const StatusHead&)>& fits = {});
  bleed_v1_Journal journal(const std::function<bool(const bleed_v1_Journal&)>& fits);
  std::string sceneName();
  SceneHead scene(const std::function<bool(const SceneHead&)>& fits = {});

  /// Hash of the state after `count` steps from a reset of the paused session.
  std::uint64_t hashAfterReset(std::uint32_t count, const std::function<void()>& meanwhile);

 private:
  template <class T>
  bool next(transport::Reader<T>& reader, const std::function<bool(const T&)>& use);

  transport::Participant participant_;
  transport::Uuid client_ = transport::drawUuid();
  std::uint64_t run_ = transport::drawRun();
  std::uint64_t seq_ = 0;
  bleed_v1_Request numbered(std::uint64_t seq, const bleed_v1_RequestBody& body) const;

  transport::Reader<bleed_v1_Frame> frames_;
  transport::Reader<bleed_v1_FrameStats> stats_;
  transport::Reader<bleed_v1_Status> statuses_;
  transport::Reader<bleed_v1_Scene> scenes_;
  transport::Reader<bleed_v1_Reply> replies_;
  transport::Reader<bleed_v1_Journal> journal_;
  transport::Writer<bleed_v1_Request> requests_;
  std::optional<transport::Writer<bleed_v1_Instrument>> instruments_;
};

}  // namespace bleedsim::service_test
