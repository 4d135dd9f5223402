#include "service/daemon/supervisor.h"

#include <algorithm>
#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <utility>

#include "service/status/session_state_name.h"

namespace bleedsim::daemon {
namespace {

constexpr std::chrono::seconds kLookPeriod{1};
constexpr std::chrono::milliseconds kShortestPeriod{10};
// Several looks within the time that the service manager waits: one slow step costs nothing.
constexpr int kLooksPerWatchdog = 4;
constexpr std::chrono::seconds kStatePeriod{5};

Clock::duration periodFor(const std::optional<Clock::duration>& watchdog) {
  if (!watchdog) return kLookPeriod;
  return std::clamp<Clock::duration>(*watchdog / kLooksPerWatchdog, kShortestPeriod, kLookPeriod);
}

/// One line, whatever the text holds.
std::string stateText(const dds::StatusReport& report) {
  std::string text = fmt::format("{}: real-time factor {:.2f}, {:.3f} s behind, {:.1f} s simulated, {} particles",
                                 sessionStateName(static_cast<std::uint32_t>(report.state)), report.real_time_factor,
                                 report.behind, report.sim_time, report.particles);
  if (!report.text.empty()) text += "; " + report.text;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

double inSeconds(Clock::duration time) { return std::chrono::duration<double>{time}.count(); }

}  // namespace

Supervisor::Supervisor(Channels& channels, ServiceManager manager, TimePoint now)
    : channels_{channels},
      manager_{std::move(manager)},
      period_{periodFor(manager_.watchdog)},
      watched_{{{"simulation", channels.simulation_pulse, channels.commands.wakeup()},
                {"publisher", channels.publisher_pulse, channels.publisher}}} {
  for (Watched& watched : watched_) {
    watched.beats = watched.pulse.beats();
    watched.moved_at = now;
  }
}

void Supervisor::start() {
  thread_ = std::thread{[this] { run(); }};
}

void Supervisor::stop() {
  if (!thread_.joinable()) return;
  stop_requested_.store(true, std::memory_order_relaxed);
  wakeup_.notify();
  thread_.join();
}

void Supervisor::sessionShown() {
  shown_.store(true, std::memory_order_relaxed);
  wakeup_.notify();
}

void Supervisor::run() {
  while (!stop_requested_.load(std::memory_order_relaxed)) {
    look(Clock::now());
    wakeup_.wait(Clock::now() + period_);
  }
  tell("STOPPING=1");
}

void Supervisor::look(TimePoint now) {
  bool all_go_on = true;
  for (Watched& watched : watched_) {
    if (!goesOn(watched, now)) all_go_on = false;
    watched.wakeup.notify();
  }
  if (!ready_told_ && shown_.load(std::memory_order_relaxed)) {
    ready_told_ = true;
    tell("READY=1");
  }
  if (all_go_on) tell("WATCHDOG=1");
  tellState(now);
}

/// Whether it took a turn since the last look.
bool Supervisor::goesOn(Watched& watched, TimePoint now) {
  const std::uint64_t beats = watched.pulse.beats();
  const Clock::duration still = now - watched.moved_at;
  if (beats == watched.beats) {
    if (still >= kStandstill && !std::exchange(watched.standing, true)) {
      spdlog::error("the {} thread stands still since {:.0f} s{}", watched.name, inSeconds(still),
                    manager_.watchdog ? ": the watchdog is not fed" : "");
    }
    return false;
  }
  if (std::exchange(watched.standing, false)) {
    spdlog::warn("the {} thread goes on after {:.0f} s of standstill", watched.name, inSeconds(still));
  }
  watched.beats = beats;
  watched.moved_at = now;
  return true;
}

void Supervisor::tellState(TimePoint now) {
  const dds::StatusReport report = channels_.board.read().report;
  if (report.state == told_state_ && now < next_state_) return;
  told_state_ = report.state;
  next_state_ = now + kStatePeriod;
  std::string text = stateText(report);
  for (const Watched& watched : watched_) {
    if (watched.standing) text += fmt::format("; the {} thread stands still", watched.name);
  }
  spdlog::debug("{}", text);
  tell("STATUS=" + text);
}

void Supervisor::tell(const std::string& lines) {
  if (manager_.tell) manager_.tell(lines);
}

}  // namespace bleedsim::daemon
