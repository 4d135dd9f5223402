// list, status and watch.
#include <algorithm>
#include <array>
#include <cstdio>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include "clients/bleedctl/context.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/stop_signal.h"
#include "clients/bleedctl/terminal_rows.h"

namespace bleedsim::bleedctl {
namespace {

constexpr std::chrono::milliseconds kListWindow{1000};
constexpr std::chrono::milliseconds kWatchInterval{200};
constexpr std::chrono::seconds kSceneTimeout{2};
// A session that runs sends statistics much more often; after this the reader wants to know that it is still there.
constexpr std::chrono::seconds kQuietInterval{2};

constexpr const char* kWatchText =
    "Prints a line whenever there are new statistics, at most five a second. Without them, as in a pause, it prints\n"
    "state, simulated time, step and particles: at once, when the state changes, and every 2 s. With --json such a line\n"
    "has no 'seq'. --count counts the lines of both kinds. On a terminal a line is three rows, written over the ones before.\n"
    "Frames are overdue when the statistics tell of them and they do not come: with a receive buffer that is too small for\n"
    "them, all may get lost.\n\n";

std::string paceText(const client::SessionStatus& status) {
  switch (status.pace) {
    case client::PaceMode::real_time:
      return "realtime";
    case client::PaceMode::maximum:
      return "max";
    case client::PaceMode::factor:
      break;
  }
  return fmt::format("{}", status.pace_factor);
}

/// What went wrong so far, as "  speed_clamped 3"; empty when nothing did. Counts of what came in as it should are left out.
std::string faultText(const client::FrameStats& stats) {
  constexpr std::array<std::string_view, 5> kTraffic{"requests", "requests_resent", "instrument_samples", "instruments_ended",
                                                     "checkpoints_written"};
  std::string text;
  for (const auto& [name, value] : stats.fault_counters) {
    if (value == 0 || std::find(kTraffic.begin(), kTraffic.end(), name) != kTraffic.end()) continue;
    text += fmt::format("{}{} {}", text.empty() ? "  " : ", ", name, value);
  }
  return text;
}

/// Frames that came and that did not. One or two may just be on their way.
std::string frameText(const client::FrameCounters& frames) {
  constexpr std::uint64_t kOnTheirWay = 2;
  std::string text = fmt::format("{} frames, {} gaps", frames.received, frames.gaps);
  if (frames.overdue > kOnTheirWay) text += fmt::format(", {} overdue", frames.overdue);
  if (frames.malformed > 0) text += fmt::format(", {} malformed", frames.malformed);
  return text;
}

JsonObject statusJson(const client::SessionStatus& status) {
  JsonObject json;
  json.add("session", status.name).add("state", client::toString(status.state)).add("epoch", status.epoch);
  json.add("step", status.step).add("sim_time_s", status.sim_time_s).add("pace", paceText(status));
  json.add("real_time_factor", status.real_time_factor).add("behind_s", status.behind_s);
  json.add("frame_rate_hz", status.frame_rate_hz);
  json.add("particles", status.particles).add("wounds", status.wounds).add("text", status.text);
  json.add("version", status.version).add("host", status.host).add("pid", status.pid).add("heartbeat", status.heartbeat);
  JsonObject counters;
  for (const auto& [name, value] : status.counters) counters.add(name, value);
  json.raw("counters", counters.text());
  JsonArray clients;
  for (const client::ClientActivity& client : status.clients) {
    JsonObject entry;
    entry.add("client", client::toString(client.client)).add("requests", client.requests).add("refused", client.refused);
    entry.add("busy", client.busy).add("resent", client.resent).add("instrument_samples", client.instrument_samples);
    entry.add("instruments_rejected", client.instruments_rejected).add("silent_s", client.silent_s);
    clients.raw(entry.text());
  }
  json.raw("clients", clients.text());
  if (status.lease_client) {
    JsonObject lease;
    json.raw("lease", lease.add("client", client::toString(*status.lease_client)).add("left_s", status.lease_left_s).text());
  }
  return json;
}

int runList(const Context& context) {
  Result<client::Client> client = client::Client::create(context.connection);
  if (!client) return fail(client.status());
  const std::vector<client::SessionStatus> sessions = client->listSessions(kListWindow);
  if (context.json) {
    JsonArray array;
    for (const client::SessionStatus& status : sessions) array.raw(statusJson(status).text());
    fmt::print("{}\n", array.text());
    return kDone;
  }
  if (sessions.empty()) fmt::print(stderr, "no sessions on domain {}\n", context.connection.domain);
  for (const client::SessionStatus& status : sessions) {
    fmt::print("{:<20} {:<8} {:>10.3f} s {:>9} particles  {} pid {}\n", status.name, client::toString(status.state),
               status.sim_time_s, status.particles, status.host, status.pid);
  }
  return kDone;
}

void printStatus(const client::SessionStatus& status, const Result<client::SceneInfo>& scene) {
  fmt::print("session           {} ({} on {}, pid {})\n", status.name, status.version, status.host, status.pid);
  fmt::print("state             {}{}{}\n", client::toString(status.state), status.text.empty() ? "" : ": ", status.text);
  fmt::print("simulated         {:.3f} s, step {}, epoch {}\n", status.sim_time_s, status.step, status.epoch);
  fmt::print("pace              {}, real-time factor {:.2f}, {:.3f} s behind\n", paceText(status), status.real_time_factor,
             status.behind_s);
  fmt::print("frames            {} per simulated second\n", status.frame_rate_hz);
  fmt::print("particles         {}, wounds {}\n", status.particles, status.wounds);
  if (scene.ok()) {
    std::string effects;
    for (const std::string& effect : scene->effects) effects += (effects.empty() ? "" : ", ") + effect;
    fmt::print("scene             {} ({}, seed {}, SIMD {})\n", scene->name, scene->precision, scene->seed, scene->simd_target);
    fmt::print("effects           {}\n", effects);
    fmt::print("spacing           {} mm, capacity {}\n", scene->spacing_m * 1e3, scene->capacity);
  }
  for (const auto& [name, value] : status.counters) {
    if (value != 0) fmt::print("{:<17} {}\n", name, value);
  }
  if (status.lease_client) {
    fmt::print("lease             of client {} for up to {:.1f} s more: nobody else may command\n",
               client::toString(*status.lease_client), status.lease_left_s);
  }
  for (const client::ClientActivity& client : status.clients) {
    fmt::print(
        "client {}: {} requests ({} refused, {} busy, {} resent), {} instrument samples ({} rejected), silent for {:.1f} s\n",
        client::toString(client.client), client.requests, client.refused, client.busy, client.resent, client.instrument_samples,
        client.instruments_rejected, client.silent_s);
  }
}

int runStatus(const Context& context) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, {.delivery = client::Delivery::none}, code);
  if (!connection) return code;
  const auto any = [](const client::SessionStatus&) { return true; };
  const Result<client::SessionStatus> status = connection->session.waitStatus(any, context.timeout());
  if (!status) return fail(status.status());
  Result<client::SceneInfo> scene = Status{StatusCode::unavailable, "the scene is loading"};
  if (status->state != client::SessionState::loading) scene = connection->session.waitScene(kSceneTimeout);
  if (!context.json) {
    printStatus(*status, scene);
    return kDone;
  }
  JsonObject json = statusJson(*status);
  if (scene.ok()) {
    JsonArray effects;
    for (const std::string& effect : scene->effects) effects.raw(jsonString(effect));
    JsonObject scene_json;
    scene_json.add("name", scene->name).add("seed", scene->seed).raw("effects", effects.text());
    scene_json.add("spacing_m", scene->spacing_m).add("capacity", scene->capacity).add("build_id", scene->build_id);
    scene_json.add("simd_target", scene->simd_target).add("precision", scene->precision).add("frame_id", scene->frame_id);
    json.raw("scene", scene_json.text());
  }
  fmt::print("{}\n", json.text());
  return kDone;
}

/// "density +0.31 %, 46 steps of 812 us: force 401, density 203, neighbors 88": the error that the speed of sound allows, and
/// what a step costs, the dearest stages by name.
std::string costText(const client::FrameStats& stats) {
  constexpr std::size_t kShown = 3;
  std::vector<std::pair<std::string, double>> stages = stats.stage_costs_us;
  double step = 0.0;
  for (const auto& [name, microseconds] : stages) step += microseconds;
  std::sort(stages.begin(), stages.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text =
      fmt::format("density +{:.2f} %, {} steps of {:.0f} us", 100.0 * stats.max_density_error, stats.steps_in_frame, step);
  for (std::size_t k = 0; k < std::min(kShown, stages.size()); ++k)
    text += fmt::format("{} {} {:.0f}", k == 0 ? ":" : ",", stages[k].first, stages[k].second);
  return text;
}

/// Prints what `watch` sees: figures for new statistics, otherwise the state, at once where none are to be expected.
class WatchPrinter {
 public:
  explicit WatchPrinter(const Context& context) : context_{context} {}

  /// Looks at the session; true when a line was printed.
  bool look(client::Session& session) {
    session.tryTakeFrame();
    const std::optional<client::SessionStatus> status = session.status();
    if (!status) return false;
    const std::optional<client::FrameStats> stats = session.stats();
    const auto now = std::chrono::steady_clock::now();
    if (stats && stats->seq != shown_seq_) {
      printFigures(*status, *stats, session.frameCounters());
      shown_seq_ = stats->seq;
    } else if ((status->state != shown_state_ && status->state != client::SessionState::running) ||
               now - printed_at_ >= kQuietInterval) {
      printState(*status);
    } else {
      return false;
    }
    shown_state_ = status->state;
    printed_at_ = now;
    std::fflush(stdout);
    return true;
  }

  /// Leaves the cursor below the last line.
  void finish() const {
    if (overwrites()) fmt::print("\n");
  }

 private:
  bool overwrites() const { return terminal_ && !context_.json; }

  void printFigures(const client::SessionStatus& status, const client::FrameStats& stats, const client::FrameCounters& frames) {
    if (context_.json) {
      JsonObject json;
      json.add("state", client::toString(status.state)).add("seq", stats.seq).add("step", stats.step);
      json.add("sim_time_s", stats.sim_time_s).add("real_time_factor", stats.real_time_factor).add("behind_s", stats.behind_s);
      json.add("particles", stats.particles).add("ml_emitted", stats.emitted_ml).add("frames", frames.received);
      json.add("dt_s", stats.dt_s).add("steps_in_frame", stats.steps_in_frame);
      json.add("mean_density_error", stats.mean_density_error).add("max_density_error", stats.max_density_error);
      JsonObject stages;
      for (const auto& [name, microseconds] : stats.stage_costs_us) stages.add(name, microseconds);
      json.raw("stage_costs_us", stages.text());
      JsonObject counters;
      for (const auto& [name, value] : stats.fault_counters) counters.add(name, value);
      json.add("gaps", frames.gaps).add("overdue", frames.overdue).add("malformed", frames.malformed);
      fmt::print("{}\n", json.raw("fault_counters", counters.text()).text());
      return;
    }
    show({fmt::format("{:<7} {:>9.3f} s  {:>5.2f} x real time, {:.3f} s behind  {:>8} particles", client::toString(status.state),
                      stats.sim_time_s, stats.real_time_factor, stats.behind_s, stats.particles),
          fmt::format("{:>9.3f} mL  {}{}", stats.emitted_ml, frameText(frames), faultText(stats)), costText(stats)});
  }

  void printState(const client::SessionStatus& status) {
    if (context_.json) {
      JsonObject json;
      json.add("state", client::toString(status.state)).add("step", status.step).add("sim_time_s", status.sim_time_s);
      fmt::print("{}\n", json.add("particles", status.particles).add("text", status.text).text());
      return;
    }
    show({fmt::format("{:<7} {:>9.3f} s  step {}  {:>8} particles  no new frames{}{}", client::toString(status.state),
                      status.sim_time_s, status.step, status.particles, status.text.empty() ? "" : ": ", status.text)});
  }

  /// One line, or as many rows on a terminal, which they stay on.
  void show(const std::vector<std::string>& parts) {
    if (!terminal_) {
      fmt::print("{}\n", fmt::join(parts, "  "));
      return;
    }
    fmt::print("{}", overwriteRows(rows_, parts, terminalColumns() - 1));
    rows_ = parts.size();
  }

  const Context& context_;
  const bool terminal_ = isatty(STDOUT_FILENO) == 1;
  std::size_t rows_ = 0;         // that stand on the terminal
  std::uint64_t shown_seq_ = 0;  // sessions count from 1
  client::SessionState shown_state_ = client::SessionState::running;
  std::chrono::steady_clock::time_point printed_at_ = std::chrono::steady_clock::now();
};

int runWatch(const Context& context, std::uint64_t count) {
  int code = kDone;
  std::optional<Connection> connection = connect(context, {}, code);
  if (!connection) return code;
  holdStopSignals();
  client::Session& session = connection->session;
  WatchPrinter printer{context};
  std::uint64_t printed = 0;
  bool stopped = false;
  while (!stopped && session.alive() && (count == 0 || printed < count)) {
    if (printer.look(session)) ++printed;
    if (count == 0 || printed < count) stopped = waitForStopSignal(kWatchInterval);
  }
  printer.finish();
  if (stopped || (count > 0 && printed >= count)) return kDone;
  return fail(kNoSession, fmt::format("session '{}' is gone", session.name()));
}

}  // namespace

void addSessionCommands(CLI::App& app, Context& context) {
  app.add_subcommand("list", "List the sessions that run")->callback([&context] {
    context.action = [&context] { return runList(context); };
  });
  app.add_subcommand("status", "Show a session's state and scene")->callback([&context] {
    context.action = [&context] { return runStatus(context); };
  });
  CLI::App* watch = app.add_subcommand(
      "watch", "Show time, real-time factor, particles, mL, gaps, density error and the cost of a step until Ctrl-C");
  watch->footer(kWatchText + watch->get_footer());  // what all commands say follows
  const auto count = std::make_shared<std::uint64_t>(0);
  watch->add_option("--count", *count, "End after so many lines; 0: never")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 40U))
      ->type_name("N");
  watch->callback([&context, count] { context.action = [&context, count] { return runWatch(context, *count); }; });
}

}  // namespace bleedsim::bleedctl
