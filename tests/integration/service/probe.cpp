#include "tests/integration/service/probe.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <stdexcept>
#include <unistd.h>
#include <utility>

namespace bleedsim::service_test {
namespace {

using transport::Participant;
using transport::Reader;
using transport::readerQos;
using transport::Topic;
using transport::Writer;

constexpr std::uint32_t kFirstDomain = 40;
constexpr std::uint32_t kDomains = 20;
constexpr std::chrono::milliseconds kResend{500};

template <class T>
T need(Result<T> result) {
  if (!result) throw std::runtime_error{result.status().message()};
  return std::move(*result);
}

Participant join(std::uint32_t domain) {
  transport::ParticipantOptions options;
  options.domain = domain;
  return need(Participant::create(options));
}

}  // namespace

std::string smallScene(double instrument_expiry_s) {
  return fmt::format(
      "name: 'small'\n"
      "domain {{ lower_m {{ x: -0.03 y: -0.03 z: -0.012 }} upper_m {{ x: 0.03 y: 0.03 z: 0.03 }} capacity: 2000 }}\n"
      "resolution {{ spacing_m: 0.003 }}\n"
      "compressibility {{ design_speed_m_per_s: 0.3 max_fall_or_depth_m: 0.004 }}\n"
      "effects {{ gravity {{ acceleration_m_per_s2 {{ z: -9.81 }} }} pressure {{}} viscosity {{}} applied_force {{}} }}\n"
      "tissue {{ plane {{ normal {{ z: 1.0 }} }} }}\n"
      "wounds {{ name: 'cut' disc {{ radius_m: 0.003 }} flow_ml_per_s: 1.5 }}\n"
      "commands {{ instrument_expiry_s: {} }}\n",
      instrument_expiry_s);
}

void ServiceTest::SetUp() {
  const std::string tag = fmt::format("service-test-{}", getpid());
  setenv("BLEEDSIM_DDS_TAG", tag.c_str(), 1);
  domain_ = kFirstDomain + static_cast<std::uint32_t>(getpid()) % kDomains;
  scene_file_ = std::filesystem::temp_directory_path() / (tag + ".textproto");
  std::ofstream{scene_file_} << smallScene();
}

void ServiceTest::TearDown() { std::remove(scene_file_.c_str()); }

std::vector<std::string> ServiceTest::daemonCommand(const std::string& session, const std::vector<std::string>& more) const {
  std::vector<std::string> command{BLEEDSIM_BLEEDD,         "--scene",   scene_file_, "--session", session, "--domain",
                                   std::to_string(domain_), "--threads", "1"};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}

std::uint64_t StatusHead::counter(const std::string& counter_name) const {
  for (const auto& [known, value] : counters) {
    if (known == counter_name) return value;
  }
  ADD_FAILURE() << "no counter " << counter_name;
  return 0;
}

bleed_v1_ClientActivity StatusHead::activityOf(const transport::Uuid& client) const {
  for (const bleed_v1_ClientActivity& activity : clients) {
    if (transport::toUuid(activity.client) == client) return activity;
  }
  return {};
}

Probe::Probe(std::uint32_t domain, const std::string& session, Reading frames)
    : participant_{join(domain)},
      frames_{need(Reader<bleed_v1_Frame>::create(participant_, session, readerQos(Topic::frame, frames)))},
      stats_{need(Reader<bleed_v1_FrameStats>::create(participant_, session, readerQos(Topic::frame_stats, Reading::recorder)))},
      statuses_{need(Reader<bleed_v1_Status>::create(participant_, session, readerQos(Topic::status, Reading::recorder)))},
      scenes_{need(Reader<bleed_v1_Scene>::create(participant_, session))},
      replies_{need(Reader<bleed_v1_Reply>::create(participant_, session))},
      journal_{need(Reader<bleed_v1_Journal>::create(participant_, session))},
      requests_{need(Writer<bleed_v1_Request>::create(participant_, session))},
      instruments_{need(Writer<bleed_v1_Instrument>::create(participant_, session))} {}

bleed_v1_RequestBody Probe::body(std::uint32_t kind, const Body& fill) {
  bleed_v1_RequestBody out{};
  out._d = kind;
  if (fill) fill(out);
  return out;
}

// Takes one sample at a time, so that nothing is taken and then forgotten.
template <class T>
bool Probe::next(Reader<T>& reader, const std::function<bool(const T&)>& use) {
  auto wait_set = need(transport::WaitSet::create(participant_));
  if (!wait_set.attach(reader, 0)) return false;
  const auto end = std::chrono::steady_clock::now() + test::kPatience;
  while (std::chrono::steady_clock::now() < end) {
    bool found = false;
    const auto look = [&](const transport::Sample<T>& sample) { found = sample.data != nullptr && use(*sample.data); };
    const auto taken = reader.take(look, 1);
    if (found) return true;
    if (!taken) return false;
    if (*taken == 0 && !wait_set.wait(test::kPatience)) return false;
  }
  return false;
}

bleed_v1_Reply Probe::ask(const bleed_v1_RequestBody& body) { return askAs(++seq_, body); }

bleed_v1_Request Probe::numbered(std::uint64_t seq, const bleed_v1_RequestBody& body) const {
  bleed_v1_Request request{};
  transport::copyUuid(client_, request.client);
  request.run = run_;
  request.seq = seq;
  request.body = body;
  return request;
}

bool Probe::send(const bleed_v1_RequestBody& body) { return requests_.write(numbered(++seq_, body)).ok(); }

bleed_v1_Reply Probe::askAs(std::uint64_t seq, const bleed_v1_RequestBody& body) {
  const bleed_v1_Request request = numbered(seq, body);
  auto wait_set = need(transport::WaitSet::create(participant_));
  EXPECT_TRUE(wait_set.attach(replies_, 0).ok());
  const auto end = std::chrono::steady_clock::now() + test::kPatience;
  while (std::chrono::steady_clock::now() < end) {
    EXPECT_TRUE(requests_.write(request).ok());
    const auto resend_at = std::chrono::steady_clock::now() + kResend;
    while (std::chrono::steady_clock::now() < resend_at) {
      std::optional<bleed_v1_Reply> mine;
      const auto look = [&](const transport::Sample<bleed_v1_Reply>& sample) {
        if (sample.data != nullptr && sample.data->seq == seq && sample.data->run == run_) mine = *sample.data;
      };
      while (need(replies_.take(look)) > 0) {}
      if (mine) return *mine;
      EXPECT_TRUE(wait_set.wait(kResend).ok());
    }
  }
  ADD_FAILURE() << "no reply to request " << seq;
  return {};
}

bool Probe::trySendInstrument(std::uint64_t seq, const std::function<void(bleed_v1_Instrument&)>& spoil) {
  bleed_v1_Instrument sample{};
  transport::copyUuid(client_, sample.client);
  sample.seq = seq;
  sample.stamp_ns = transport::monotonicNow();
  sample.position = {0.0, 0.0, 0.003};
  sample.orientation.w = 1.0;
  sample.tip_radius_m = 0.01;
  sample.force = {0.0, 0.0, 1e-4};
  if (spoil) spoil(sample);
  return instruments_->write(sample).ok();
}

void Probe::matchInstruments() {
  auto wait_set = need(transport::WaitSet::create(participant_));
  EXPECT_TRUE(wait_set.attachMatches(*instruments_, 0).ok());
  while (instruments_->matchedCount() == 0) {
    const auto woken = wait_set.wait(test::kPatience);
    if (!woken) FAIL() << "nobody reads instruments";
  }
}

FrameHead Probe::frame(const std::function<bool(const FrameHead&)>& fits) {
  FrameHead head;
  EXPECT_TRUE(next<bleed_v1_Frame>(frames_, [&](const bleed_v1_Frame& frame) {
    head = {transport::toUuid(frame.session), frame.seq, frame.step, frame.epoch, frame.count, frame.payload._length};
    return !fits || fits(head);
  })) << "no such frame";
  return head;
}

StatsHead Probe::stats(const std::function<bool(const StatsHead&)>& fits) {
  StatsHead head;
  EXPECT_TRUE(next<bleed_v1_FrameStats>(stats_, [&](const bleed_v1_FrameStats& stats) {
    head = {stats.seq,
            stats.step,
            stats.epoch,
            stats.state_hash,
            stats.wounds._length,
            stats.instruments._length,
            stats.frames_overwritten,
            stats.kinetic_energy_j};
    return !fits || fits(head);
  })) << "no such frame_stats";
  return head;
}

StatusHead Probe::status(const std::function<bool(const StatusHead&)>& fits) {
  StatusHead head;
  EXPECT_TRUE(next<bleed_v1_Status>(statuses_, [&](const bleed_v1_Status& status) {
    head = {transport::toUuid(status.session),
            status.session_name,
            status.state,
            status.step,
            status.heartbeat,
            status.pid,
            {},
            status.text,
            {},
            transport::toUuid(status.lease_client)};
    for (std::uint32_t i = 0; i < status.clients._length; ++i) head.clients.push_back(status.clients._buffer[i]);
    for (std::uint32_t i = 0; i < status.counters._length; ++i) {
      head.counters.emplace_back(status.counters._buffer[i].name, status.counters._buffer[i].value);
    }
    return !fits || fits(head);
  })) << "no such status";
  return head;
}

bleed_v1_Journal Probe::journal(const std::function<bool(const bleed_v1_Journal&)>& fits) {
  bleed_v1_Journal out{};
  EXPECT_TRUE(next<bleed_v1_Journal>(journal_, [&](const bleed_v1_Journal& entry) {
    out = entry;
    return fits(entry);
  })) << "no such journal entry";
  return out;
}

SceneHead Probe::scene(const std::function<bool(const SceneHead&)>& fits) {
  SceneHead head;
  EXPECT_TRUE(next<bleed_v1_Scene>(scenes_, [&](const bleed_v1_Scene& scene) {
    head = {scene.scene_name, scene.epoch, scene.scene_text, scene.loaded_text, {}, {}};
    for (std::uint32_t i = 0; i < scene.effects._length; ++i) head.effects.emplace_back(scene.effects._buffer[i]);
    for (std::uint32_t i = 0; i < scene.known_effects._length; ++i)
      head.known_effects.emplace_back(scene.known_effects._buffer[i]);
    return !fits || fits(head);
  })) << "no such scene";
  return head;
}

std::string Probe::sceneName() {
  std::string name;
  EXPECT_TRUE(next<bleed_v1_Scene>(scenes_, [&](const bleed_v1_Scene& scene) {
    name = scene.scene_name;
    return true;
  })) << "no scene";
  return name;
}

std::uint64_t Probe::hashAfterReset(std::uint32_t count, const std::function<void()>& meanwhile) {
  const bleed_v1_Reply reset = ask(bleed_v1_REQUEST_RESET);
  EXPECT_EQ(reset.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << reset.reason;
  if (meanwhile) meanwhile();
  const bleed_v1_Reply stepped = ask(bleed_v1_REQUEST_STEP, [count](auto& body) { body._u.step.count = count; });
  EXPECT_EQ(stepped.code, static_cast<std::uint32_t>(bleed_v1_REPLY_ACCEPTED)) << stepped.reason;
  return stats([&](const StatsHead& head) { return head.epoch == reset.epoch && head.step == count; }).state_hash;
}

}  // namespace bleedsim::service_test
