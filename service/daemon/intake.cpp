#include "service/daemon/intake.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "service/dds/decode.h"
#include "service/transport/clock.h"

namespace bleedsim::daemon {
namespace {

enum Token : unsigned { kRequests, kInstruments, kWriters, kStop };

// Until the queue has room again for what a lost writer leaves behind.
constexpr std::chrono::milliseconds kRetry{20};

}  // namespace

Result<std::unique_ptr<Intake>> Intake::create(const transport::Participant& participant, const std::string& session,
                                               Channels& channels) {
  auto requests = transport::Reader<bleed_v1_Request>::create(participant, session);
  if (!requests) return requests.status();
  auto instruments = transport::Reader<bleed_v1_Instrument>::create(participant, session);
  if (!instruments) return instruments.status();
  Result<transport::GuardCondition> stop = transport::GuardCondition::create(participant);
  if (!stop) return stop.status();
  Result<transport::WaitSet> wait_set = transport::WaitSet::create(participant);
  if (!wait_set) return wait_set.status();
  if (Status attached = wait_set->attach(*requests, kRequests); !attached) return attached;
  if (Status attached = wait_set->attach(*instruments, kInstruments); !attached) return attached;
  if (Status attached = wait_set->attachMatches(*requests, kWriters); !attached) return attached;
  if (Status attached = wait_set->attachMatches(*instruments, kWriters); !attached) return attached;
  if (Status attached = wait_set->attach(*stop, kStop); !attached) return attached;
  Ends ends{std::move(*requests), std::move(*instruments), std::move(*stop), std::move(*wait_set)};
  return std::unique_ptr<Intake>{new Intake{std::move(ends), channels}};
}

void Intake::requestStop() { ends_.stop.raise(); }

Status Intake::run() {
  for (;;) {
    const std::chrono::nanoseconds longest = lost_.empty() ? std::chrono::nanoseconds{-1} : kRetry;
    const Result<transport::WakeUp> woken = ends_.wait_set.wait(longest);
    if (!woken) return woken.status();
    if (woken->has(kStop)) return {};
    if (Status drained = drain(); !drained) return drained;
    if (woken->has(kWriters)) noticeLostWriters();
    tellOfLostWriters();
  }
}

Status Intake::drain() {
  const Result<std::size_t> requests = ends_.requests.take([this](const transport::Sample<bleed_v1_Request>& sample) {
    if (sample.data != nullptr) takeRequest(*sample.data, sample.publication);
  });
  if (!requests) return requests.status();
  const Result<std::size_t> instruments = ends_.instruments.take([this](const transport::Sample<bleed_v1_Instrument>& sample) {
    if (sample.data != nullptr) takeInstrument(*sample.data, sample.publication);
  });
  return instruments ? Status{} : instruments.status();
}

void Intake::noticeLostWriters() {
  std::vector<transport::PublicationHandle> alive = ends_.instruments.matchedPublications();
  const std::vector<transport::PublicationHandle> requesting = ends_.requests.matchedPublications();
  alive.insert(alive.end(), requesting.begin(), requesting.end());
  std::erase_if(senders_, [&](const auto& known) {
    const auto& [writer, sender] = known;
    if (std::find(alive.begin(), alive.end(), writer) != alive.end()) return false;
    lost_.push_back({writer, sender});
    return true;
  });
  for (const transport::PublicationHandle writer : alive) {
    if (!senders_.contains(writer)) {
      const std::uint64_t participant = ends_.requests.participantOf(writer);
      senders_[writer] = participant != 0 ? participant : senderOf(ends_.instruments, writer);
    }
  }
}

void Intake::tellOfLostWriters() {
  // In the order of the sender's own inputs: what it sent before is carried out before.
  std::erase_if(lost_, [this](const WriterLost& lost) { return channels_.commands.tryPush(WriterLost{lost}); });
}

template <class T>
std::uint64_t Intake::senderOf(const transport::Reader<T>& reader, transport::PublicationHandle writer) {
  if (const auto known = senders_.find(writer); known != senders_.end()) return known->second;
  const std::uint64_t participant = reader.participantOf(writer);
  // Without one it is gone already, and nothing will tell that it is lost.
  if (participant == 0) return writer;
  return senders_[writer] = participant;
}

void Intake::takeRequest(const bleed_v1_Request& sample, transport::PublicationHandle writer) {
  const std::int64_t received = transport::monotonicNow();
  channels_.counters.add(ServiceCounter::requests);
  const dds::RequestKey key = dds::requestKey(sample);
  const std::uint64_t sender = senderOf(ends_.requests, writer);
  channels_.clients.heard(key.origin.client, dds::ClientCount::requests, received, sender);
  ReplyCache::Answer known = channels_.reply_cache.begin(key, sender);
  if (known.missed > 0) channels_.counters.add(ServiceCounter::requests_missed, known.missed);
  switch (known.known) {
    case ReplyCache::Known::fresh:
      break;
    case ReplyCache::Known::in_work:
      noteResent(key);
      return;
    case ReplyCache::Known::answered:
      noteResent(key);
      send(std::move(*known.reply));
      return;
    case ReplyCache::Known::stale: {
      channels_.counters.add(ServiceCounter::requests_stale);
      dds::Reply reply = replyTo(key, received);
      reply.code = dds::ReplyCode::stale;
      reply.reason = "this request is older than the replies that are kept: give each request a higher number";
      send(std::move(reply));
      return;
    }
  }
  Result<dds::Action> action = dds::decodeAction(sample.body);
  if (!action) {
    refuse(replyTo(key, received), action.status());
    return;
  }
  Result<std::string> wound_name = dds::decodeWoundName(sample.body);
  if (!wound_name) {
    refuse(replyTo(key, received), wound_name.status());
    return;
  }
  // A ping changes nothing, so it does not wait for a step.
  if (const auto* ping = std::get_if<dds::Ping>(&*action)) {
    dds::Reply reply = replyTo(key, received);
    reply.client_stamp_ns = ping->client_stamp_ns;
    send(std::move(reply));
    return;
  }
  dds::DecodedRequest request{
      key, std::move(*action), std::move(*wound_name), writer, sender, received, std::make_unique<dds::RequestCopy>(sample)};
  if (channels_.commands.tryPush(std::move(request))) return;
  channels_.counters.add(ServiceCounter::requests_busy);
  channels_.clients.note(key.origin.client, dds::ClientCount::busy);
  dds::Reply reply = replyTo(key, received);
  reply.code = dds::ReplyCode::busy;
  reply.reason = "too many requests of yours are waiting: send it again";
  send(std::move(reply));
}

void Intake::takeInstrument(const bleed_v1_Instrument& sample, transport::PublicationHandle writer) {
  channels_.counters.add(ServiceCounter::instrument_samples);
  const dds::Uuid client = transport::toUuid(sample.client);
  const std::uint64_t sender = senderOf(ends_.instruments, writer);
  channels_.clients.heard(client, dds::ClientCount::instrument_samples, transport::monotonicNow(), sender);
  const auto reject = [&](ServiceCounter why) {
    channels_.counters.add(why);
    channels_.clients.note(client, dds::ClientCount::instruments_rejected);
  };
  Result<dds::InstrumentSample> decoded = dds::decodeInstrument(sample);
  if (!decoded) {
    reject(ServiceCounter::instruments_malformed);
    return;
  }
  decoded->writer = writer;
  decoded->sender = sender;
  if (!channels_.commands.tryPush(InstrumentInput{std::move(*decoded), Clock::now()})) {
    reject(ServiceCounter::instruments_dropped);
  }
}

dds::Reply Intake::replyTo(const dds::RequestKey& key, std::int64_t received) const {
  const dds::StatusReport now = channels_.board.read().report;
  dds::Reply reply;
  reply.key = key;
  reply.applied_step = now.step + 1;
  reply.sim_time = now.sim_time;
  reply.epoch = now.epoch;
  reply.receive_stamp_ns = received;
  return reply;
}

void Intake::noteResent(const dds::RequestKey& key) {
  channels_.counters.add(ServiceCounter::requests_resent);
  channels_.clients.note(key.origin.client, dds::ClientCount::resent);
}

void Intake::refuse(dds::Reply reply, const Status& why) {
  channels_.counters.add(ServiceCounter::requests_refused);
  channels_.clients.note(reply.key.origin.client, dds::ClientCount::refused);
  reply.code = dds::replyCode(why.code());
  reply.reason = why.message();
  send(std::move(reply));
}

void Intake::send(dds::Reply reply) {
  const dds::RequestKey key = reply.key;
  const bool first_time = reply.reply_stamp_ns == 0;
  if (!channels_.replies.tryPush(std::move(reply), Channels::kRepliesOfSimulation)) {
    channels_.counters.add(ServiceCounter::replies_lost);
    // Nothing was done yet, so the request may come again as if it were new.
    if (first_time) channels_.reply_cache.forget(key);
  }
  channels_.publisher.notify();
}

}  // namespace bleedsim::daemon
