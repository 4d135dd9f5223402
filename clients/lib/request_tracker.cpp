#include "clients/lib/request_tracker.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace bleedsim::client {

std::future<Reply> RequestTracker::add(const RequestPointer& request, std::int64_t now_ns, std::int64_t timeout_ns) {
  if (pending_.size() >= kMaxPending) {
    std::promise<Reply> full;
    full.set_value({.code = ReplyCode::not_sent, .reason = "1024 commands wait for their reply: wait for some of them"});
    return full.get_future();
  }
  const std::uint64_t seq = next_seq_++;
  std::memcpy(request->wire.client, client_.data(), client_.size());
  request->wire.run = run_;
  request->wire.seq = seq;
  Pending& entry = pending_[seq];
  entry.request = request;
  entry.next_send_ns = now_ns;
  entry.deadline_ns = now_ns + timeout_ns;
  return entry.answer.get_future();
}

std::vector<RequestPointer> RequestTracker::due(std::int64_t now_ns) {
  std::vector<RequestPointer> out;
  for (auto& [seq, entry] : pending_) {
    if (entry.next_send_ns > now_ns) continue;
    out.push_back(entry.request);
    entry.next_send_ns = now_ns + entry.interval_ns;
    entry.interval_ns = std::min(2 * entry.interval_ns, kLongestResendNs);
  }
  return out;
}

bool RequestTracker::resolve(const Uuid& client, std::uint64_t run, std::uint64_t seq, Reply reply) {
  if (client != client_ || run != run_) return false;
  const auto found = pending_.find(seq);
  if (found == pending_.end()) return false;
  found->second.answer.set_value(std::move(reply));
  pending_.erase(found);
  return true;
}

void RequestTracker::expire(std::int64_t now_ns) {
  for (auto i = pending_.begin(); i != pending_.end();) {
    if (i->second.deadline_ns > now_ns) {
      ++i;
      continue;
    }
    i->second.answer.set_value(
        {.code = ReplyCode::no_answer, .reason = "the session gave no answer in time: see its status, then send again"});
    i = pending_.erase(i);
  }
}

void RequestTracker::endAll(const std::string& reason) {
  for (auto& [seq, entry] : pending_) entry.answer.set_value({.code = ReplyCode::no_answer, .reason = reason});
  pending_.clear();
}

std::int64_t RequestTracker::nextEvent() const {
  std::int64_t next = std::numeric_limits<std::int64_t>::max();
  for (const auto& [seq, entry] : pending_) next = std::min({next, entry.next_send_ns, entry.deadline_ns});
  return next;
}

}  // namespace bleedsim::client
