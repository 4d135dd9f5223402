#include "clients/lib/session_impl.h"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <utility>

#include "clients/lib/convert.h"
#include "clients/lib/frame_decoder.h"
#include "clients/lib/request_builder.h"
#include "service/transport/clock.h"
#include "service/transport/uuid.h"

namespace bleedsim::client {
namespace {

using transport::Reader;
using transport::Sample;
using transport::Topic;
using transport::Writer;

enum Token : unsigned { kSamples, kPeers, kGuard };

constexpr std::chrono::seconds kLongestWait{1};
constexpr std::size_t kMaxQueue = 256;

template <class T>
Status make(std::optional<Reader<T>>& into, const transport::Participant& participant, const std::string& session,
            const transport::EndpointQos& qos, transport::WaitSet& waits) {
  Result<Reader<T>> made = Reader<T>::create(participant, session, qos);
  if (!made) return made.status();
  into.emplace(std::move(*made));
  return waits.attach(*into, kSamples);
}

/// Takes until the reader is empty.
template <class T, class Use>
void drain(Reader<T>& reader, Use&& use) {
  for (;;) {
    const Result<std::size_t> taken = reader.take([&](const Sample<T>& sample) {
      if (sample.data != nullptr) use(*sample.data);
    });
    if (!taken || *taken < Reader<T>::kMaxBatch) return;
  }
}

transport::EndpointQos frameQos(Topic topic, const SessionOptions& options) {
  if (options.delivery == Delivery::newest) return transport::readerQos(topic, transport::Reading::live);
  transport::EndpointQos qos = transport::readerQos(topic, transport::Reading::recorder);
  qos.depth = std::max(qos.depth, static_cast<std::int32_t>(options.queue_length));
  return qos;
}

}  // namespace

struct Session::Impl::Endpoints {
  std::optional<Reader<bleed_v1_Frame>> frame;
  std::optional<Reader<bleed_v1_FrameStats>> stats;
  std::optional<Reader<bleed_v1_Status>> status;
  std::optional<Reader<bleed_v1_Scene>> scene;
  std::optional<Reader<bleed_v1_Reply>> reply;
  Writer<bleed_v1_Request> request;
  transport::GuardCondition guard;
  transport::WaitSet waits;
};

Result<std::unique_ptr<Session::Impl>> Session::Impl::open(const transport::Participant& participant, const std::string& name,
                                                           const SessionOptions& options) {
  if (options.queue_length < 1 || options.queue_length > kMaxQueue) {
    return Status{StatusCode::invalid_argument, fmt::format("queue_length is {}: use 1 to {}", options.queue_length, kMaxQueue)};
  }
  if (options.command_timeout.count() <= 0) return Status{StatusCode::invalid_argument, "command_timeout has to be positive"};
  auto request = Writer<bleed_v1_Request>::create(participant, name);
  if (!request) return request.status();
  auto guard = transport::GuardCondition::create(participant);
  if (!guard) return guard.status();
  auto waits = transport::WaitSet::create(participant);
  if (!waits) return waits.status();
  std::unique_ptr<Endpoints> e{new Endpoints{{}, {}, {}, {}, {}, std::move(*request), std::move(*guard), std::move(*waits)}};

  Status made = e->waits.attach(e->guard, kGuard);
  const auto add = [&](auto& reader, const transport::EndpointQos& qos) {
    if (made.ok()) made = make(reader, participant, name, qos, e->waits);
  };
  add(e->status, transport::readerQos(Topic::status));
  add(e->scene, transport::readerQos(Topic::scene));
  add(e->reply, transport::readerQos(Topic::reply));
  add(e->stats, frameQos(Topic::frame_stats, options));
  if (options.delivery != Delivery::none) add(e->frame, frameQos(Topic::frame, options));
  if (made.ok()) made = e->waits.attachMatches(*e->status, kPeers);
  if (made.ok()) made = e->waits.attachMatches(*e->reply, kPeers);
  if (made.ok()) made = e->waits.attachMatches(e->request, kPeers);
  if (!made.ok()) return made;
  return std::unique_ptr<Impl>{new Impl{participant, name, options, std::move(e)}};
}

Session::Impl::Impl(const transport::Participant& with, const std::string& session, const SessionOptions& chosen,
                    std::unique_ptr<Endpoints> endpoints)
    : name{session},
      options{chosen},
      participant{with},
      client{transport::drawUuid()},
      frames{chosen.delivery == Delivery::newest ? 1 : chosen.queue_length},
      endpoints_{std::move(endpoints)},
      tracker_{client, transport::drawRun()},
      thread_{[this] { serve(); }} {}

Session::Impl::~Impl() {
  stopping_ = true;
  endpoints_->guard.raise();
  thread_.join();
  tracker_.endAll("the session was closed before an answer came");
}

Status Session::Impl::waitMatched(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{mutex};
  if (changed.wait_for(lock, timeout, [&] { return matched; })) return {};
  return {StatusCode::timed_out,
          fmt::format("session '{}' was seen, but its command channel did not open in time: is its process stopped?", name)};
}

std::future<Reply> Session::Impl::submit(const RequestPointer& request) { return submit(request, options.command_timeout); }

std::future<Reply> Session::Impl::submit(Result<RequestPointer> request) {
  if (request) return submit(*request, options.command_timeout);
  std::promise<Reply> refused;
  refused.set_value({.code = ReplyCode::not_sent, .reason = request.status().message()});
  return refused.get_future();
}

std::future<Reply> Session::Impl::submit(const RequestPointer& request, std::chrono::nanoseconds timeout) {
  std::future<Reply> answer;
  {
    const std::lock_guard lock{request_mutex_};
    answer = tracker_.add(request, transport::monotonicNow(), timeout.count());
    sendDue();
  }
  endpoints_->guard.raise();  // the thread has a nearer time to wake at
  return answer;
}

void Session::Impl::sendDue() {
  const std::int64_t now = transport::monotonicNow();
  tracker_.expire(now);
  for (const RequestPointer& request : tracker_.due(now)) {
    // A full writer is no failure yet: the request is sent again until its time runs out.
    if (!endpoints_->request.write(request->wire)) break;
  }
}

void Session::Impl::serve() {
  while (!stopping_) {
    std::int64_t next = 0;
    {
      const std::lock_guard lock{request_mutex_};
      sendDue();
      next = tracker_.nextEvent();
    }
    const std::int64_t longest = std::chrono::nanoseconds{kLongestWait}.count();
    std::int64_t wait = longest;
    if (next != std::numeric_limits<std::int64_t>::max()) {
      wait = std::clamp<std::int64_t>(next - transport::monotonicNow(), 0, longest);
    }
    const Result<transport::WakeUp> woken = endpoints_->waits.wait(std::chrono::nanoseconds{wait});
    if (!woken) return;
    if (woken->has(kGuard)) endpoints_->guard.lower();
    takeReplies();
    takeState();
    takeStats();
    if (endpoints_->frame) takeFrames();
    watchPeers();
    tellConnection();
  }
}

void Session::Impl::takeReplies() {
  drain(*endpoints_->reply, [&](const bleed_v1_Reply& wire) {
    Reply reply = fromWire(wire);
    const Uuid to = transport::toUuid(wire.client);
    if (to != client) return;
    reply.arrival_stamp_ns = transport::monotonicNow();
    if (reply.client_stamp_ns > 0) {
      // Before the future is answered, so that ping() finds its own sample in the estimate.
      const std::lock_guard state{mutex};
      had_offset = true;
      clock.add(reply.client_stamp_ns, reply.receive_stamp_ns, reply.reply_stamp_ns, reply.arrival_stamp_ns);
    }
    const std::lock_guard lock{request_mutex_};
    tracker_.resolve(to, wire.run, wire.seq, std::move(reply));
  });
}

void Session::Impl::takeState() {
  bool news = false;
  drain(*endpoints_->status, [&](const bleed_v1_Status& wire) {
    SessionStatus value = fromWire(wire);
    const std::lock_guard lock{mutex};
    alive = value.state != SessionState::stopped;
    heard = true;
    if (status && status->session != value.session) {
      replaced_ = true;
      clock = {};
    }
    status = std::move(value);
    news = true;
  });
  drain(*endpoints_->scene, [&](const bleed_v1_Scene& wire) {
    SceneInfo value = fromWire(wire);
    const std::lock_guard lock{mutex};
    scene = std::move(value);
    news = true;
  });
  if (news) changed.notify_all();
}

void Session::Impl::takeStats() {
  drain(*endpoints_->stats, [&](const bleed_v1_FrameStats& wire) {
    FrameStats value = fromWire(wire);
    if (options.on_stats) options.on_stats(value);
    const std::lock_guard lock{mutex};
    if (endpoints_->frame) gaps.told(value.session, value.seq);
    stats = std::move(value);
  });
}

void Session::Impl::takeFrames() {
  bool news = false;
  drain(*endpoints_->frame, [&](const bleed_v1_Frame& wire) {
    auto frame = std::make_shared<Frame>();
    const Status decoded = FrameDecoder::decode(wire, *frame);
    {
      const std::lock_guard lock{mutex};
      if (!decoded.ok()) {
        ++counters.malformed;
        return;
      }
      ++counters.received;
      gaps.note(frame->header().session, frame->header().seq);
      if (!options.on_frame) frames.put(frame);
      counters.dropped = frames.dropped();
      news = true;
    }
    if (options.on_frame) options.on_frame(frame);
  });
  if (news) changed.notify_all();
}

void Session::Impl::watchPeers() {
  // All are asked, whatever the first says: a status that stays uncleared would wake the wait set without end.
  const bool status_writer = endpoints_->status->aliveCount() > 0;
  const bool request_reader = endpoints_->request.matchedCount() > 0;
  const bool reply_writer = endpoints_->reply->aliveCount() > 0;
  const bool connected = status_writer && request_reader && reply_writer;
  const std::lock_guard lock{mutex};
  const bool stopped = status && status->state == SessionState::stopped;
  // Which daemon has come back is known with its first status.
  const bool now_alive = !stopped && (!matched || (status_writer && heard));
  if (!now_alive) heard = false;
  if (connected == matched && now_alive == alive) return;
  // Once matched, a session counts as gone when its writers are: "matched" only ever rises.
  matched = matched || connected;
  alive = now_alive;
  changed.notify_all();
}

void Session::Impl::tellConnection() {
  ConnectionState now;
  bool ping = false;
  {
    const std::lock_guard lock{mutex};
    if (alive == connection.connected && !replaced_) return;
    if (connection.connected && !alive) ++connection.losses;
    if (std::exchange(replaced_, false)) ++connection.replacements;
    connection.connected = alive;
    now = connection;
    ping = alive && had_offset;
  }
  changed.notify_all();
  // The path may be another one, and the daemon's clock another host's.
  if (ping) submit(buildPing(transport::monotonicNow()));
  if (options.on_connection) options.on_connection(now);
}

}  // namespace bleedsim::client
