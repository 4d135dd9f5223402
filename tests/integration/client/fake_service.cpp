#include "tests/integration/client/fake_service.h"

#include <optional>
#include <unistd.h>

namespace bleedsim::client_test {

using transport::Reader;
using transport::Sample;
using transport::Writer;

namespace {

std::vector<bleed_v1_Counter> wireCounters(const std::vector<std::pair<std::string, std::uint64_t>>& counters) {
  std::vector<bleed_v1_Counter> out;
  for (const auto& [name, value] : counters) {
    bleed_v1_Counter& counter = out.emplace_back();
    name.copy(counter.name, sizeof counter.name - 1);
    counter.value = value;
  }
  return out;
}

}  // namespace

struct FakeService::Endpoints {
  Writer<bleed_v1_Status> status;
  Writer<bleed_v1_Scene> scene;
  Writer<bleed_v1_Frame> frame;
  Writer<bleed_v1_FrameStats> stats;
  Writer<bleed_v1_Reply> reply;
  Writer<bleed_v1_Journal> journal;
  Reader<bleed_v1_Request> request;
  Reader<bleed_v1_Instrument> instrument;
  transport::GuardCondition guard;
  transport::WaitSet waits;
};

Result<std::unique_ptr<FakeService>> FakeService::start(const transport::Participant& participant, const std::string& name,
                                                        Judge judge) {
  auto status = Writer<bleed_v1_Status>::create(participant, name);
  auto scene = Writer<bleed_v1_Scene>::create(participant, name);
  auto frame = Writer<bleed_v1_Frame>::create(participant, name);
  auto stats = Writer<bleed_v1_FrameStats>::create(participant, name);
  auto reply = Writer<bleed_v1_Reply>::create(participant, name);
  auto journal = Writer<bleed_v1_Journal>::create(participant, name);
  auto request = Reader<bleed_v1_Request>::create(participant, name);
  auto instrument = Reader<bleed_v1_Instrument>::create(participant, name);
  auto guard = transport::GuardCondition::create(participant);
  auto waits = transport::WaitSet::create(participant);
  if (!status || !scene || !frame || !stats || !reply || !journal || !request || !instrument || !guard || !waits) {
    return Status{StatusCode::io, "could not make the endpoints of the fake service"};
  }
  std::unique_ptr<Endpoints> e{new Endpoints{std::move(*status), std::move(*scene), std::move(*frame), std::move(*stats),
                                             std::move(*reply), std::move(*journal), std::move(*request), std::move(*instrument),
                                             std::move(*guard), std::move(*waits)}};
  for (const Status& attached : {e->waits.attach(e->request, 0), e->waits.attach(e->instrument, 0), e->waits.attach(e->guard, 1),
                                 e->waits.attachMatches(e->frame, 0)}) {
    if (!attached.ok()) return attached;
  }
  return std::unique_ptr<FakeService>{new FakeService{name, std::move(judge), std::move(e)}};
}

FakeService::FakeService(std::string name, Judge judge, std::unique_ptr<Endpoints> endpoints)
    : name_{std::move(name)}, judge_{std::move(judge)}, endpoints_{std::move(endpoints)}, thread_{[this] { serve(); }} {}

FakeService::~FakeService() {
  {
    const std::lock_guard lock{mutex_};
    stopping_ = true;
  }
  endpoints_->guard.raise();
  thread_.join();
}

void FakeService::serve() {
  for (;;) {
    if (!endpoints_->waits.wait(std::chrono::seconds{1})) return;
    const std::lock_guard lock{mutex_};
    if (stopping_) return;
    static_cast<void>(endpoints_->request.take([&](const Sample<bleed_v1_Request>& sample) {
      if (sample.data == nullptr) return;
      request_seqs_.push_back(sample.data->seq);
      bleed_v1_Reply reply{};
      std::memcpy(reply.client, sample.data->client, sizeof reply.client);
      reply.run = sample.data->run;
      reply.seq = sample.data->seq;
      reply.receive_stamp_ns = transport::monotonicNow();
      if (sample.data->body._d == bleed_v1_REQUEST_PING) reply.client_stamp_ns = sample.data->body._u.ping.client_stamp_ns;
      const bool answer = !judge_ || judge_(*sample.data, reply);
      reply.reply_stamp_ns = transport::monotonicNow();
      if (answer) static_cast<void>(endpoints_->reply.write(reply).ok());
    }));
    static_cast<void>(endpoints_->instrument.take([&](const Sample<bleed_v1_Instrument>& sample) {
      if (sample.data != nullptr) instruments_.push_back(*sample.data);
    }));
    frame_readers_ = endpoints_->frame.matchedCount();
    changed_.notify_all();
  }
}

void FakeService::publishStatus(std::uint32_t state, const std::string& text) {
  bleed_v1_Status status{};
  transport::copyUuid(session, status.session);
  name_.copy(status.session_name, sizeof status.session_name - 1);
  status.state = state;
  status.step = step;
  status.start_stamp_ns = start_stamp_ns;
  status.heartbeat = ++heartbeat_;
  status.pid = getpid();
  status.real_time_factor = figures.real_time_factor;
  status.behind_s = figures.behind_s;
  text.copy(status.text, sizeof status.text - 1);
  std::vector<bleed_v1_Counter> counters = wireCounters(figures.counters);
  status.counters._buffer = counters.data();
  status.counters._length = status.counters._maximum = static_cast<std::uint32_t>(counters.size());
  static_cast<void>(endpoints_->status.write(status).ok());
}

void FakeService::publishScene(const std::string& scene_name) {
  bleed_v1_Scene scene{};
  transport::copyUuid(session, scene.session);
  scene_name.copy(scene.scene_name, sizeof scene.scene_name - 1);
  std::string text = "# " + scene_name;
  scene.scene_text = text.data();
  scene.spacing_m = 0.003;
  scene.capacity = capacity;
  static_cast<void>(endpoints_->scene.write(scene).ok());
}

Status FakeService::publishFrame(std::uint64_t seq, std::uint32_t count) {
  if (Status written = publishBareFrame(seq, count); !written) return written;
  return publishStats(seq, count);
}

Status FakeService::publishBareFrame(std::uint64_t seq, std::uint32_t count) {
  bleed_v1_Attribute attributes[2] = {{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F},
                                      {bleed_v1_SEMANTIC_ID, bleed_v1_SCALAR_UINT32, 1, 1.0F, 0.0F}};
  std::vector<std::uint8_t> payload(std::size_t{count} * 16);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float position[3] = {static_cast<float>(seq), static_cast<float>(i), 0.5F};
    std::memcpy(payload.data() + std::size_t{i} * 12, position, sizeof position);
    std::memcpy(payload.data() + std::size_t{count} * 12 + std::size_t{i} * 4, &i, sizeof i);
  }
  bleed_v1_Frame frame{};
  transport::copyUuid(session, frame.session);
  frame.seq = seq;
  frame.step = 10 * seq;
  frame.sim_time_s = static_cast<double>(seq) / 60.0;
  frame.count = count;
  frame.attributes = {2, 2, attributes, false};
  frame.payload._buffer = payload.data();
  frame.payload._length = frame.payload._maximum = static_cast<std::uint32_t>(payload.size());
  step = frame.step;
  return endpoints_->frame.write(frame);
}

Status FakeService::publishStats(std::uint64_t seq, std::uint32_t count) {
  bleed_v1_FrameStats stats{};
  transport::copyUuid(session, stats.session);
  stats.seq = seq;
  stats.step = 10 * seq;
  stats.sim_time_s = static_cast<double>(seq) / 60.0;
  stats.particles = count;
  stats.emitted_ml = 0.5 * static_cast<double>(seq);
  stats.real_time_factor = figures.real_time_factor;
  stats.behind_s = figures.behind_s;
  std::vector<bleed_v1_Counter> counters = wireCounters(figures.counters);
  stats.fault_counters._buffer = counters.data();
  stats.fault_counters._length = stats.fault_counters._maximum = static_cast<std::uint32_t>(counters.size());
  return endpoints_->stats.write(stats);
}

Status FakeService::publishJournal(std::uint64_t number, std::uint64_t at_step) {
  bleed_v1_Journal journal{};
  transport::copyUuid(session, journal.session);
  journal.number = number;
  journal.step = at_step;
  journal.body._d = bleed_v1_JOURNAL_INSTRUMENT_END;
  return endpoints_->journal.write(journal);
}

Status FakeService::publishMalformedFrame(std::uint64_t seq) {
  bleed_v1_Attribute attributes[2] = {{bleed_v1_SEMANTIC_POSITION, bleed_v1_SCALAR_FLOAT32, 3, 1.0F, 0.0F},
                                      {bleed_v1_SEMANTIC_ID, bleed_v1_SCALAR_UINT32, 1, 1.0F, 0.0F}};
  std::uint8_t payload[15] = {};
  bleed_v1_Frame frame{};
  transport::copyUuid(session, frame.session);
  frame.seq = seq;
  frame.count = 1;
  frame.attributes = {2, 2, attributes, false};
  frame.payload = {sizeof payload, sizeof payload, payload, false};
  return endpoints_->frame.write(frame);
}

bool FakeService::waitRequests(std::size_t count) {
  std::unique_lock lock{mutex_};
  return changed_.wait_for(lock, std::chrono::seconds{20}, [&] { return request_seqs_.size() >= count; });
}

bool FakeService::waitInstruments(std::size_t count) {
  std::unique_lock lock{mutex_};
  return changed_.wait_for(lock, std::chrono::seconds{20}, [&] { return instruments_.size() >= count; });
}

bool FakeService::waitFrameReaders(std::size_t count) {
  std::unique_lock lock{mutex_};
  return changed_.wait_for(lock, std::chrono::seconds{20}, [&] { return frame_readers_ >= count; });
}

bool FakeService::waitNoFrameReaders() {
  std::unique_lock lock{mutex_};
  return changed_.wait_for(lock, std::chrono::seconds{20}, [&] { return frame_readers_ == 0; });
}

std::vector<std::uint64_t> FakeService::requestSeqs() {
  const std::lock_guard lock{mutex_};
  return request_seqs_;
}

std::vector<bleed_v1_Instrument> FakeService::instruments() {
  const std::lock_guard lock{mutex_};
  return instruments_;
}

}  // namespace bleedsim::client_test
