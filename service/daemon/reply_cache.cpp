#include "service/daemon/reply_cache.h"

#include <algorithm>

namespace bleedsim::daemon {

ReplyCache::Answer ReplyCache::begin(const dds::RequestKey& key) {
  const std::lock_guard lock{mutex_};
  auto place = places_.find(key.origin);
  if (place == places_.end()) {
    if (clients_.size() == kClients) {
      places_.erase(clients_.back().origin);
      clients_.pop_back();
    }
    clients_.push_front({.origin = key.origin, .requests = {}});
    place = places_.emplace(key.origin, clients_.begin()).first;
  } else {
    clients_.splice(clients_.begin(), clients_, place->second);
  }
  Client& client = *place->second;
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
  return {Known::fresh, {}};
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
