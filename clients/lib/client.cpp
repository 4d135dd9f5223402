#include "bleedsim/client.h"

#include <algorithm>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <mutex>

#include "clients/lib/client_impl.h"
#include "clients/lib/convert.h"
#include "clients/lib/session_impl.h"
#include "service/transport/clock.h"

namespace bleedsim::client {

Result<std::unique_ptr<Client::Impl>> Client::Impl::create(const ClientOptions& options) {
  auto participant =
      transport::Participant::create({.domain = options.domain, .interface = options.interface, .tag = options.tag});
  if (!participant) return participant.status();
  auto reader = transport::Reader<bleed_v1_Status>::create(
      *participant, transport::kAnySession, transport::readerQos(transport::Topic::status, transport::Reading::discovery));
  if (!reader) return reader.status();
  auto waits = transport::WaitSet::create(*participant);
  if (!waits) return waits.status();
  if (Status attached = waits->attach(*reader, 0); !attached) return attached;
  return std::unique_ptr<Impl>{new Impl{std::move(*participant), std::move(*reader), std::move(*waits)}};
}

void Client::Impl::takeStatus() {
  for (;;) {
    const auto taken = reader_.take([&](const transport::Sample<bleed_v1_Status>& sample) {
      if (sample.data == nullptr) return;
      SessionStatus status = fromWire(*sample.data);
      const auto same = [&](const Seen& other) { return other.status.session == status.session; };
      const auto known = std::find_if(seen_.begin(), seen_.end(), same);
      if (known != seen_.end()) {
        *known = {std::move(status), sample.publication};
      } else if (seen_.size() < kMaxSessions) {
        seen_.push_back({std::move(status), sample.publication});
      }
    });
    if (!taken || *taken == 0) break;
  }
  const std::vector<transport::PublicationHandle> alive = reader_.matchedPublications();
  std::erase_if(seen_, [&](const Seen& seen) {
    return seen.status.state == SessionState::stopped || std::find(alive.begin(), alive.end(), seen.publication) == alive.end();
  });
}

std::vector<SessionStatus> Client::Impl::sessions() {
  const std::lock_guard lock{mutex_};
  takeStatus();
  std::vector<SessionStatus> out;
  for (const Seen& seen : seen_) out.push_back(seen.status);
  return out;
}

Result<SessionStatus> Client::Impl::find(const std::string& name, std::chrono::nanoseconds timeout) {
  if (!name.empty()) {
    if (Status valid = transport::checkSessionName(name); !valid) return valid;
  }
  const std::int64_t deadline = transport::monotonicNow() + timeout.count();
  for (;;) {
    const std::vector<SessionStatus> all = sessions();
    const auto matches = [&](const SessionStatus& status) { return name.empty() || status.name == name; };
    const auto found = std::find_if(all.begin(), all.end(), matches);
    if (found != all.end()) return *found;
    const std::int64_t left = deadline - transport::monotonicNow();
    if (left <= 0) {
      std::vector<std::string> names;
      for (const SessionStatus& status : all) names.push_back(status.name);
      return Status{StatusCode::timed_out,
                    fmt::format("{} was found within {:.1f} s; seen: {}. Is bleedd running on the same domain and interface?",
                                name.empty() ? std::string{"no session"} : fmt::format("no session '{}'", name),
                                static_cast<double>(timeout.count()) * 1e-9,
                                names.empty() ? std::string{"none"} : fmt::format("{}", fmt::join(names, ", ")))};
    }
    wait(left);
  }
}

void Client::Impl::wait(std::int64_t left_ns) {
  // Waits in slices, so that threads that search at the same time see what another one took.
  constexpr std::int64_t kSlice = 100'000'000;
  const std::lock_guard lock{wait_mutex_};
  static_cast<void>(waits_.wait(std::chrono::nanoseconds{std::min(left_ns, kSlice)}).ok());
}

std::vector<SessionStatus> Client::Impl::listSessions(std::chrono::nanoseconds window) {
  const std::int64_t deadline = transport::monotonicNow() + window.count();
  for (std::int64_t left = window.count(); left > 0; left = deadline - transport::monotonicNow()) {
    wait(left);
    sessions();
  }
  return sessions();
}

Client::Client(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
Client::Client(Client&&) noexcept = default;
Client& Client::operator=(Client&&) noexcept = default;
Client::~Client() = default;

Result<Client> Client::create(const ClientOptions& options) {
  Result<std::unique_ptr<Impl>> impl = Impl::create(options);
  if (!impl) return impl.status();
  return Client{std::move(*impl)};
}

std::vector<SessionStatus> Client::sessions() { return impl_->sessions(); }
std::vector<SessionStatus> Client::listSessions(std::chrono::nanoseconds window) { return impl_->listSessions(window); }
Result<SessionStatus> Client::find(const std::string& name, std::chrono::nanoseconds timeout) {
  return impl_->find(name, timeout);
}

Result<Session> Client::open(const std::string& name, const SessionOptions& options, std::chrono::nanoseconds timeout) {
  const std::int64_t deadline = transport::monotonicNow() + timeout.count();
  const Result<SessionStatus> found = impl_->find(name, timeout);
  if (!found) return found.status();
  Result<std::unique_ptr<Session::Impl>> session = Session::Impl::open(impl_->participant(), found->name, options);
  if (!session) return session.status();
  // A session found at the last moment still gets the time that matching takes.
  const std::int64_t left = std::max<std::int64_t>(deadline - transport::monotonicNow(), 500'000'000);
  if (Status matched = (*session)->waitMatched(std::chrono::nanoseconds{left}); !matched) return matched;
  return Session{std::move(*session)};
}

}  // namespace bleedsim::client
