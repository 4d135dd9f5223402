#include "service/daemon/reply_cache.h"

#include <algorithm>

namespace bleedsim::daemon {

void ReplyCache::forgetOne() {
  const auto most =
      std::max_element(starts_.begin(), starts_.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto last =
      std::find_if(clients_.rbegin(), clients_.rend(), [&](const Client& one) { return one.sender == most->first; });
  places_.erase(last->origin);
  clients_.erase(std::prev(last.base()));
  if (--most->second == 0) starts_.erase(most);
}

ReplyCache::Client& ReplyCache::find(const dds::ClientRun& origin, std::uint64_t sender) {
  if (const auto place = places_.find(origin); place != places_.end()) {
    clients_.splice(clients_.begin(), clients_, place->second);
    return *place->second;
  }
  if (clients_.size() == kClients) forgetOne();
  clients_.push_front({.origin = origin, .sender = sender, .requests = {}});
  places_.emplace(origin, clients_.begin());
  ++starts_[sender];
  return clients_.front();
}

ReplyCache::Answer ReplyCache::begin(const dds::RequestKey& key, std::uint64_t sender) {
  const std::lock_guard lock{mutex_};
  Client& client = find(key.origin, sender);
  if (const auto known = client.requests.find(key.seq); known != client.requests.end()) {
    if (!known->second) return {Known::in_work, {}};
    return {Known::answered, known->second};
  }
  if (key.seq <= client.dropped_through) return {Known::stale, {}};
  client.requests.emplace(key.seq, std::nullopt);
  if (client.requests.size() > kRequests) {
    const auto oldest = client.requests.begin();
    client.dropped_through = std::max(client.dropped_through, oldest->first);
    const bool dropped_itself = oldest->first == key.seq;
    client.requests.erase(oldest);
    if (dropped_itself) return {Known::stale, {}};
  }
  Answer fresh;
  if (client.highest > 0 && key.seq > client.highest) fresh.missed = key.seq - client.highest - 1;
  client.highest = std::max(client.highest, key.seq);
  return fresh;
}

void ReplyCache::finish(const dds::Reply& reply) {
  const std::lock_guard lock{mutex_};
  const auto place = places_.find(reply.key.origin);
  if (place == places_.end()) return;
  const auto request = place->second->requests.find(reply.key.seq);
  if (request != place->second->requests.end()) request->second = reply;
}

void ReplyCache::forget(const dds::RequestKey& key) {
  const std::lock_guard lock{mutex_};
  const auto place = places_.find(key.origin);
  if (place != places_.end()) place->second->requests.erase(key.seq);
}

std::size_t ReplyCache::clientCount() const {
  const std::lock_guard lock{mutex_};
  return clients_.size();
}

}  // namespace bleedsim::daemon
