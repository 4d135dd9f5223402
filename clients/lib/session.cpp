#include "bleedsim/session.h"

#include <fmt/core.h>

#include "clients/lib/request_builder.h"
#include "clients/lib/session_impl.h"
#include "service/transport/clock.h"

namespace bleedsim::client {

Session::Session(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

const std::string& Session::name() const { return impl_->name; }

FramePointer Session::tryTakeFrame() {
  const std::lock_guard lock{impl_->mutex};
  return impl_->frames.take();
}

Result<FramePointer> Session::waitFrame(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{impl_->mutex};
  if (impl_->changed.wait_for(lock, timeout, [&] { return !impl_->frames.empty(); })) return impl_->frames.take();
  return Status{StatusCode::timed_out,
                fmt::format("no frame of session '{}' came in time: is it paused, or its frame rate low?", impl_->name)};
}

FrameCounters Session::frameCounters() const {
  const std::lock_guard lock{impl_->mutex};
  FrameCounters counters = impl_->counters;
  counters.gaps = impl_->gaps.gaps();
  counters.overdue = impl_->gaps.overdue();
  return counters;
}

std::optional<FrameStats> Session::stats() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->stats;
}

std::optional<SessionStatus> Session::status() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->status;
}

std::optional<SceneInfo> Session::scene() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->scene;
}

Result<SessionStatus> Session::waitStatus(const std::function<bool(const SessionStatus&)>& condition,
                                          std::chrono::nanoseconds timeout) {
  std::unique_lock lock{impl_->mutex};
  const auto fulfilled = [&] { return impl_->status && condition(*impl_->status); };
  if (impl_->changed.wait_for(lock, timeout, fulfilled)) return *impl_->status;
  return Status{StatusCode::timed_out, fmt::format("session '{}' did not reach the awaited state in time; it is {}", impl_->name,
                                                   impl_->status ? toString(impl_->status->state) : "silent")};
}

Result<SceneInfo> Session::waitScene(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{impl_->mutex};
  if (impl_->changed.wait_for(lock, timeout, [&] { return impl_->scene.has_value(); })) return *impl_->scene;
  return Status{StatusCode::timed_out, fmt::format("session '{}' sent no scene in time: it may still be loading", impl_->name)};
}

bool Session::alive() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->alive;
}

ConnectionState Session::connection() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->connection;
}

bool Session::waitAlive(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{impl_->mutex};
  return impl_->changed.wait_for(lock, timeout, [&] { return impl_->alive; });
}

bool Session::waitGone(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{impl_->mutex};
  return impl_->changed.wait_for(lock, timeout, [&] { return !impl_->alive; });
}

std::future<Reply> Session::addWound(const WoundSpec& wound) { return impl_->submit(buildAddWound(wound)); }
std::future<Reply> Session::updateWound(std::uint32_t wound_id, const WoundChange& change) {
  return impl_->submit(buildUpdateWound(wound_id, change));
}
std::future<Reply> Session::moveWound(std::uint32_t wound_id, const Vec3& position, const std::optional<Vec3>& normal) {
  return impl_->submit(buildUpdateWound(wound_id, {.position = position, .normal = normal}));
}
std::future<Reply> Session::removeWound(std::uint32_t wound_id) { return impl_->submit(buildRemoveWound(wound_id)); }
std::future<Reply> Session::updateWound(const std::string& name, const WoundChange& change) {
  return impl_->submit(buildUpdateWound(name, change));
}
std::future<Reply> Session::removeWound(const std::string& name) { return impl_->submit(buildRemoveWound(name)); }
std::future<Reply> Session::force(const ForceSpec& force) { return impl_->submit(buildForce(force)); }
std::future<Reply> Session::pause() { return impl_->submit(buildPlain(bleed_v1_REQUEST_PAUSE)); }
std::future<Reply> Session::resume() { return impl_->submit(buildPlain(bleed_v1_REQUEST_RESUME)); }
std::future<Reply> Session::reset() { return impl_->submit(buildPlain(bleed_v1_REQUEST_RESET)); }
std::future<Reply> Session::step(std::uint32_t count) { return impl_->submit(buildStep(count)); }
std::future<Reply> Session::pace(const Pace& pace) { return impl_->submit(buildPace(pace)); }
std::future<Reply> Session::output(const OutputSpec& output) { return impl_->submit(buildOutput(output)); }
std::future<Reply> Session::loadScene(const std::string& text) { return impl_->submit(buildLoadScene(text)); }
std::future<Reply> Session::setEffect(const std::string& name, bool enabled, const std::string& settings) {
  return impl_->submit(buildEffect(name, enabled, settings));
}
std::future<Reply> Session::acquireLease(std::chrono::milliseconds length) {
  return impl_->submit(buildAcquire(std::chrono::duration<double>{length}.count()));
}
std::future<Reply> Session::releaseLease() { return impl_->submit(buildPlain(bleed_v1_REQUEST_RELEASE)); }
const Uuid& Session::clientId() const { return impl_->client; }
std::future<Reply> Session::checkpoint(const std::string& name) { return impl_->submit(buildCheckpoint(name)); }
std::future<Reply> Session::restore(const std::string& name) { return impl_->submit(buildRestore(name)); }
std::future<Reply> Session::shutdown() { return impl_->submit(buildPlain(bleed_v1_REQUEST_SHUTDOWN)); }

Result<std::chrono::nanoseconds> Session::ping(std::chrono::nanoseconds timeout) {
  const std::int64_t sent = transport::monotonicNow();
  const Reply reply = impl_->submit(buildPing(sent), timeout).get();
  if (reply.code == ReplyCode::no_answer) return Status{StatusCode::timed_out, reply.reason};
  if (!reply.accepted()) return Status{StatusCode::unavailable, fmt::format("ping refused: {}", reply.reason)};
  return std::chrono::nanoseconds{reply.arrival_stamp_ns - sent};
}

std::optional<ClockOffset> Session::clockOffset() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->clock.best();
}

}  // namespace bleedsim::client
