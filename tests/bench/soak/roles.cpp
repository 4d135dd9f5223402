#include "tests/bench/soak/roles.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <deque>
#include <fmt/core.h>
#include <future>
#include <limits>
#include <sys/resource.h>
#include <thread>

#include "bleedsim/client.h"
#include "service/transport/clock.h"
#include "service/transport/reader.h"
#include "service/transport/uuid.h"
#include "service/transport/writer.h"

namespace bleedsim::soak {
namespace {

using namespace std::chrono_literals;
using transport::Participant;
using transport::Topic;
using transport::Writer;

constexpr auto kPatience = 30s;
constexpr int kFloodPerMillisecond = 10;  // 10 kHz
constexpr int kBurst = 7000;              // of 150 bytes: 1 MB

constexpr std::size_t kCommandsUnderWay = 100;
constexpr int kNice = 10;

/// The raw end of the wire: what the client library would not send.
struct RawClient {
  Participant participant;
  Writer<bleed_v1_Request> requests;
  Writer<bleed_v1_Instrument> instruments;
  bleed_v1_Request request{};
  bleed_v1_Instrument sample{};

  static Result<RawClient> create(const Place& place) {
    Result<Participant> participant = Participant::create({.domain = place.domain});
    if (!participant) return participant.status();
    auto requests = Writer<bleed_v1_Request>::create(*participant, place.session);
    if (!requests) return requests.status();
    auto instruments = Writer<bleed_v1_Instrument>::create(*participant, place.session);
    if (!instruments) return instruments.status();
    RawClient out{*participant, std::move(*requests), std::move(*instruments)};
    const transport::Uuid client = transport::drawUuid();
    transport::copyUuid(client, out.request.client);
    transport::copyUuid(client, out.sample.client);
    out.request.run = transport::drawRun();
    out.sample.position = {0.0, 0.0, 0.005};
    out.sample.orientation.w = 1.0;
    out.sample.tip_radius_m = 0.003;
    out.sample.force = {0.0, 0.0, 1e-5};
    return out;
  }

  // What finds no room is lost, as of any client that sends too fast.
  void send(std::uint32_t kind) {
    ++request.seq;
    request.body._d = kind;
    static_cast<void>(requests.write(request).ok());
  }
  void push(std::uint32_t tool) {
    ++sample.seq;
    sample.tool = tool;
    sample.stamp_ns = transport::monotonicNow();
    static_cast<void>(instruments.write(sample).ok());
  }
};

void floodRequests(RawClient& raw) {
  for (;;) {
    for (int i = 0; i < kFloodPerMillisecond; ++i) raw.send(bleed_v1_REQUEST_RESUME);
    std::this_thread::sleep_for(1ms);
  }
}

void burstInstruments(RawClient& raw) {
  for (;;) {
    for (int i = 0; i < kBurst; ++i) raw.push(static_cast<std::uint32_t>(i % 100));
    std::this_thread::sleep_for(500ms);
  }
}

void sendNonsense(RawClient& raw) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::uint32_t i = 0;; ++i) {
    std::memset(&raw.request.body, 0, sizeof raw.request.body);
    raw.request.body._u.wound_add.position = {nan, 1e300, -1e300};
    constexpr std::uint32_t kKinds[] = {bleed_v1_REQUEST_WOUND_ADD, bleed_v1_REQUEST_STEP, bleed_v1_REQUEST_PACE, 99};
    raw.send(kKinds[i % 4]);
    raw.sample.force.x = i % 2 == 0 ? nan : 1e300;
    raw.push(0);
    std::this_thread::sleep_for(5ms);
  }
}

void restartUnderOneUuid(RawClient& raw) {
  for (;;) {
    raw.request.run = transport::drawRun();
    raw.request.seq = 0;
    for (int i = 0; i < 20; ++i) raw.send(bleed_v1_REQUEST_RESUME);
    std::this_thread::sleep_for(200ms);
  }
}

void holdStaleClocks(RawClient& raw) {
  for (;;) {
    raw.request.body._u.ping.client_stamp_ns = std::numeric_limits<std::int64_t>::max();
    raw.send(bleed_v1_REQUEST_PING);
    ++raw.sample.seq;
    raw.sample.stamp_ns = 1;
    static_cast<void>(raw.instruments.write(raw.sample).ok());
    std::this_thread::sleep_for(10ms);
  }
}

/// `command`: with a command for each frame, whose answer nobody waits for.
int subscribe(const Place& place, client::Delivery delivery, std::chrono::milliseconds between, bool command = false) {
  auto client = client::Client::create({.domain = place.domain});
  if (!client) return 1;
  auto session = client->open(place.session, {.delivery = delivery}, kPatience);
  if (!session) return 1;
  std::deque<std::future<client::Reply>> replies;
  for (;;) {
    static_cast<void>(session->waitFrame(1s).ok());
    if (command) {
      replies.push_back(session->updateWound("cut", {.flow_ml_per_s = 0.5}));
      if (replies.size() > kCommandsUnderWay) replies.pop_front();
    }
    std::this_thread::sleep_for(between);
  }
}

/// Reads what a recorder reads: the journal, too, which is reliable and kept for late joiners.
int stallWithTheJournal(const Place& place) {
  Result<Participant> participant = Participant::create({.domain = place.domain});
  if (!participant) return 1;
  auto journal = transport::Reader<bleed_v1_Journal>::create(*participant, place.session);
  if (!journal) return 1;
  return subscribe(place, client::Delivery::queue, 0ms);
}

int joinAndLeave(const Place& place) {
  for (;;) {
    auto client = client::Client::create({.domain = place.domain});
    if (!client) return 1;
    auto session = client->open(place.session, {}, kPatience);
    if (session) static_cast<void>(session->waitFrame(1s).ok());
  }
}

int crowd(const Place& place) {
  Result<Participant> participant = Participant::create({.domain = place.domain});
  if (!participant) return 1;
  std::vector<transport::Reader<bleed_v1_Frame>> readers;
  for (int i = 0; i < 200; ++i) {
    const auto reading = i % 2 == 0 ? transport::Reading::live : transport::Reading::recorder;
    auto reader =
        transport::Reader<bleed_v1_Frame>::create(*participant, place.session, transport::readerQos(Topic::frame, reading));
    if (!reader) return 1;
    readers.push_back(std::move(*reader));
  }
  for (;;) std::this_thread::sleep_for(1h);
}

}  // namespace

const std::vector<Role>& roles() {
  static const std::vector<Role> kRoles{
      {"flood", "10 kHz of requests", Treatment::leave},
      {"burst", "1 MB of instrument samples twice a second, of 100 tools", Treatment::leave},
      {"nonsense", "NaN, unknown requests, values out of range", Treatment::leave},
      {"same-uuid", "starts again five times a second under one uuid", Treatment::leave},
      {"stale-clock", "stamps of 1970 and of the year 2262", Treatment::leave},
      {"stall", "a reader of frames and journal, reliable, that is stopped for 5 s of every 10 s", Treatment::stall},
      {"die", "a reader and commander that is killed every 5 s and returns", Treatment::kill},
      {"slow", "a live reader that takes one frame a second", Treatment::leave},
      {"joiner", "joins, takes a frame, leaves, without end", Treatment::leave},
      {"crowd", "200 readers that never read, half of them reliable", Treatment::leave},
  };
  return kRoles;
}

int play(std::string_view role, const Place& place) {
  // They stand for clients on other hosts, whose work takes no time from the daemon's.
  setpriority(PRIO_PROCESS, 0, kNice);
  if (role == "stall") return stallWithTheJournal(place);
  if (role == "die") return subscribe(place, client::Delivery::queue, 0ms, true);
  if (role == "slow") return subscribe(place, client::Delivery::newest, 1000ms);
  if (role == "joiner") return joinAndLeave(place);
  if (role == "crowd") return crowd(place);
  Result<RawClient> raw = RawClient::create(place);
  if (!raw) {
    fmt::print(stderr, "soak: {}\n", raw.status().message());
    return 1;
  }
  if (role == "flood") floodRequests(*raw);
  if (role == "burst") burstInstruments(*raw);
  if (role == "nonsense") sendNonsense(*raw);
  if (role == "same-uuid") restartUnderOneUuid(*raw);
  if (role == "stale-clock") holdStaleClocks(*raw);
  fmt::print(stderr, "soak: there is no role '{}'\n", role);
  return 2;
}

}  // namespace bleedsim::soak
