// Soak: bleedd with 20 000 particles, published 60 times a second, for N minutes. In the first half one client watches and
// commands; in the second half ten more do all that trainers do wrong. Prints both halves beside each other. Fails when a command
// is lost, when one of the ten has ended by itself, or when bleedd does not end as asked.
#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fmt/core.h>
#include <fstream>
#include <memory>
#include <mutex>
#include <thread>
#include <unistd.h>

#include "bleedsim/client.h"
#include "tests/bench/soak/figures.h"
#include "tests/bench/soak/roles.h"
#include "tests/support/child_process.h"

namespace bleedsim::soak {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPatience = 30s;
constexpr auto kCommandPeriod = 100ms;
constexpr auto kTreatmentPeriod = 5s;

struct Options {
  double minutes = 30.0;
  std::uint32_t domain = 73;
  std::string bleedd;
  std::string role;
  bool json = false;
};

/// A still pool of 20 000 particles, 4 mm apart, and a wound that bleeds into it.
constexpr const char* kScene = R"(name: "soak"
domain { lower_m { z: -0.02 } upper_m { x: 0.4 y: 0.4 z: 0.1 } periodic_x: true periodic_y: true capacity: 24000 }
resolution { spacing_m: 0.004 }
compressibility { design_speed_m_per_s: 0.3 max_fall_or_depth_m: 0.01 }
effects { gravity {} pressure {} viscosity {} applied_force {} }
tissue { plane { normal { z: 1 } } }
fluid_blocks { lower_m { z: 0.0 } upper_m { x: 0.4 y: 0.4 z: 0.008 } }
wounds { name: "cut" position_m { x: 0.2 y: 0.2 } disc { radius_m: 0.01 } flow_ml_per_s: 0.5 }
)";

double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>{time}.count(); }

/// The client that behaves; its figures belong to the half that runs.
class Monitor {
 public:
  Monitor(const Place& place, int pid) : pid_{pid} {
    auto client = client::Client::create({.domain = place.domain});
    if (!client) throw std::runtime_error{client.status().message()};
    client_.emplace(std::move(*client));
    client::SessionOptions options{.delivery = client::Delivery::queue, .queue_length = 256};
    options.on_frame = [this](const client::FramePointer&) {
      const std::lock_guard lock{mutex_};
      ++now_.frames;
    };
    options.on_stats = [this](const client::FrameStats& stats) { note(stats); };
    auto session = client_->open(place.session, options, kPatience);
    if (!session) throw std::runtime_error{session.status().message()};
    session_.emplace(std::move(*session));
  }

  /// Watches and commands until then; `each` is called every 100 ms.
  template <class Each>
  Figures watch(Clock::duration length, Each&& each) {
    {
      const std::lock_guard lock{mutex_};
      now_ = {};
    }
    const std::uint64_t gaps = session_->frameCounters().gaps;
    const Clock::time_point start = Clock::now();
    for (int round = 0; Clock::now() - start < length; ++round) {
      std::this_thread::sleep_until(start + round * kCommandPeriod);
      command();
      if (round % 10 == 0) now_.memory_mib.push_back(residentMiB(pid_));
      each(round);
    }
    const std::lock_guard lock{mutex_};
    now_.wall_s = std::chrono::duration<double>{Clock::now() - start}.count();
    now_.gaps = session_->frameCounters().gaps - gaps;
    return now_;
  }

  client::Session& session() { return *session_; }

 private:
  void note(const client::FrameStats& stats) {
    double step_us = 0.0;
    for (const auto& [stage, microseconds] : stats.stage_costs_us) step_us += microseconds;
    const std::lock_guard lock{mutex_};
    if (stats.steps_in_frame > 0) now_.step_us.push_back(step_us);
    now_.steps += stats.steps_in_frame;
  }
  void command() {
    const Clock::time_point sent = Clock::now();
    const client::Reply reply = session_->updateWound("cut", {.flow_ml_per_s = 0.5}).get();
    if (reply.code == client::ReplyCode::no_answer) {
      ++now_.commands_lost;
    } else {
      now_.reply_ms.push_back(milliseconds(Clock::now() - sent));
    }
    if (reply.code == client::ReplyCode::busy) ++now_.busy;
    if (const auto pong = session_->ping(kPatience); pong.ok()) now_.ping_ms.push_back(milliseconds(*pong));
  }

  int pid_;
  std::mutex mutex_;  // covers what the session's thread writes
  Figures now_;
  std::optional<client::Client> client_;
  std::optional<client::Session> session_;
};

/// The ten, and what is done to them from outside.
class Crowd {
 public:
  Crowd(std::string self, const Place& place) : self_{std::move(self)}, place_{place} {
    for (const Role& role : roles()) players_.push_back({role, start(role)});
  }
  ~Crowd() {
    for (Player& player : players_) player.process->signal(SIGCONT);
  }
  /// How many have ended without being killed.
  std::size_t deserters() {
    std::size_t count = 0;
    for (Player& player : players_) {
      if (!player.process->wait(std::chrono::milliseconds{0})) continue;
      fmt::print(stderr, "soak: '{}' has ended: {}\n", player.role.name, player.process->output());
      ++count;
    }
    return count;
  }
  void treat() {
    if (Clock::now() < next_) return;
    next_ += kTreatmentPeriod;
    stopped_ = !stopped_;
    for (Player& player : players_) {
      if (player.role.treatment == Treatment::stall) player.process->signal(stopped_ ? SIGSTOP : SIGCONT);
      if (player.role.treatment == Treatment::kill) {
        player.process->signal(SIGKILL);
        player.process->wait();
        player.process = start(player.role);
      }
    }
  }

 private:
  struct Player {
    Role role;
    std::unique_ptr<test::ChildProcess> process;
  };
  std::unique_ptr<test::ChildProcess> start(const Role& role) const {
    return std::make_unique<test::ChildProcess>(
        std::vector<std::string>{self_, "--role", std::string{role.name}, "--domain", std::to_string(place_.domain)}, true);
  }

  std::string self_;
  Place place_;
  std::vector<Player> players_;
  Clock::time_point next_ = Clock::now() + kTreatmentPeriod;
  bool stopped_ = false;
};

int run(const Options& options, const std::string& self) {
  const std::string tag = fmt::format("soak-{}", getpid());
  setenv("BLEEDSIM_DDS_TAG", tag.c_str(), 1);
  const std::string scene = fmt::format("/tmp/bleedsim-soak-{}.textproto", getpid());
  std::ofstream{scene} << kScene;
  const Place place{options.domain, "soak"};
  // 60 frames and some 130 steps a second of wall time: a third of a core or so, as a session that keeps its pace.
  test::ChildProcess daemon{{options.bleedd, "--scene", scene, "--session", place.session, "--domain",
                             std::to_string(place.domain), "--pace", "0.06", "--frame-rate", "1000"}};
  Monitor monitor{place, daemon.pid()};
  const auto half = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{options.minutes * 30.0});
  fmt::print(stderr, "soak: the quiet half, {:.1f} minutes\n", options.minutes / 2);
  const Figures quiet = monitor.watch(half, [](int) {});
  fmt::print(stderr, "soak: the loud half, {:.1f} minutes\n", options.minutes / 2);
  Figures loud;
  std::size_t deserters = 0;
  {
    Crowd crowd{self, place};
    loud = monitor.watch(half, [&crowd](int) { crowd.treat(); });
    deserters = crowd.deserters();
    if (const auto status = monitor.session().status(); status && !options.json) {
      for (const auto& [name, value] : status->counters) {
        if (value > 0) fmt::print("{:<24} {}\n", name, value);
      }
    }
  }
  static_cast<void>(monitor.session().shutdown().get());
  const std::optional<int> code = daemon.wait();
  std::remove(scene.c_str());
  fmt::print("{}", options.json ? json(quiet, loud) : table(quiet, loud));
  if (code != 0) fmt::print(stderr, "soak: bleedd ended with {}:\n{}", code.value_or(-1), daemon.output());
  const std::uint64_t lost = quiet.commands_lost + loud.commands_lost;
  if (lost > 0) fmt::print(stderr, "soak: {} commands got no answer\n", lost);
  return code == 0 && lost == 0 && deserters == 0 ? 0 : 1;
}

int soak(int argc, char** argv) {
  Options options;
  options.bleedd = BLEEDSIM_BLEEDD;
  CLI::App app{"Runs bleedd for some minutes, half of them beside ten clients that misbehave", "soak"};
  app.add_option("--minutes", options.minutes, "Both halves together")->check(CLI::Range(0.1, 10000.0))->capture_default_str();
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0U, 230U))->capture_default_str();
  app.add_option("--bleedd", options.bleedd, "The daemon")->capture_default_str();
  app.add_flag("--json", options.json, "One JSON object");
  app.add_option("--role", options.role, "Play one of the clients; for the program itself");
  CLI11_PARSE(app, argc, argv);
  if (!options.role.empty()) return play(options.role, {options.domain, "soak"});
  return run(options, argv[0]);
}

}  // namespace
}  // namespace bleedsim::soak

int main(int argc, char** argv) {
  try {
    return bleedsim::soak::soak(argc, argv);
  } catch (const std::exception& wrong) {
    fmt::print(stderr, "soak: {}\n", wrong.what());
    return 1;
  }
}
