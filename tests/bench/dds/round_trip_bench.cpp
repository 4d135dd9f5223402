// A request to a running bleedd and its reply: a ping, which the intake answers, and a pace request, which waits for a step.
#include <benchmark/benchmark.h>
#include <csignal>
#include <optional>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "service/transport/reader.h"
#include "service/transport/uuid.h"
#include "service/transport/wait_set.h"
#include "service/transport/writer.h"

namespace {

using namespace bleedsim;

constexpr std::uint32_t kDomain = 59;
constexpr const char* kSession = "bench_round_trip";

/// bleedd in real time, for as long as one benchmark runs.
class Daemon {
 public:
  Daemon() {
    std::vector<std::string> command{BLEEDSIM_BLEEDD, "--scene",  BLEEDSIM_SCENE,         "--session",
                                     kSession,        "--domain", std::to_string(kDomain)};
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    started_ = posix_spawn(&pid_, arguments[0], nullptr, nullptr, arguments.data(), environ) == 0;
  }
  ~Daemon() {
    if (!started_) return;
    kill(pid_, SIGTERM);
    waitpid(pid_, nullptr, 0);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

 private:
  pid_t pid_ = 0;
  bool started_ = false;
};

class Requester {
 public:
  static std::optional<Requester> create() {
    transport::ParticipantOptions options;
    options.domain = kDomain;
    const auto participant = transport::Participant::create(options);
    if (!participant) return {};
    auto writer = transport::Writer<bleed_v1_Request>::create(*participant, kSession);
    auto reader = transport::Reader<bleed_v1_Reply>::create(*participant, kSession);
    auto wait_set = transport::WaitSet::create(*participant);
    if (!writer || !reader || !wait_set || !wait_set->attach(*reader, 0)) return {};
    return Requester{std::move(*writer), std::move(*reader), std::move(*wait_set)};
  }

  /// Sends until there is a reply; false if none comes.
  bool ask(const bleed_v1_RequestBody& body) {
    bleed_v1_Request request{};
    request.run = run_;
    request.seq = ++seq_;
    request.body = body;
    for (int attempt = 0; attempt < 60; ++attempt) {
      if (!writer_.write(request)) return false;
      bool answered = false;
      for (;;) {
        const auto woken = wait_set_.wait(std::chrono::milliseconds{500});
        if (!woken) return false;
        if (woken->timedOut()) break;
        const auto look = [&](const transport::Sample<bleed_v1_Reply>& sample) {
          answered = answered || (sample.data != nullptr && sample.data->run == run_ && sample.data->seq == seq_);
        };
        if (!reader_.take(look)) return false;
        if (answered) return true;
      }
    }
    return false;
  }

 private:
  Requester(transport::Writer<bleed_v1_Request> writer, transport::Reader<bleed_v1_Reply> reader, transport::WaitSet wait_set)
      : writer_{std::move(writer)}, reader_{std::move(reader)}, wait_set_{std::move(wait_set)} {}

  transport::Writer<bleed_v1_Request> writer_;
  transport::Reader<bleed_v1_Reply> reader_;
  transport::WaitSet wait_set_;
  std::uint64_t run_ = transport::drawRun();
  std::uint64_t seq_ = 0;
};

void roundTrip(benchmark::State& state, std::uint32_t kind) {
  const Daemon daemon;
  std::optional<Requester> requester = Requester::create();
  bleed_v1_RequestBody body{};
  body._d = kind;
  if (!requester || !requester->ask(body)) {
    state.SkipWithError("bleedd does not answer");
    return;
  }
  for (auto _ : state) {
    if (!requester->ask(body)) state.SkipWithError("a request got no reply");
  }
}

BENCHMARK_CAPTURE(roundTrip, ping, bleed_v1_REQUEST_PING)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK_CAPTURE(roundTrip, pace, bleed_v1_REQUEST_PACE)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
