#include <cstdio>
#include <fmt/core.h>
#include <future>
#include <map>
#include <memory>
#include <unistd.h>

#include "bleedsim/recorder.h"
#include "clients/bleedctl/json.h"
#include "clients/bleedctl/record_narrator.h"
#include "clients/bleedctl/record_outcome.h"
#include "clients/bleedctl/recording_commands.h"
#include "clients/bleedctl/stop_signal.h"
#include "service/status/number_text.h"

namespace bleedsim::bleedctl {
namespace {

constexpr std::chrono::milliseconds kTick{100};
// Closing waits up to a second for samples and then for the disk, which is done at once unless something is wrong with it.
constexpr std::chrono::seconds kUsualClosing{4};

constexpr const char* kRecordText =
    "Progress and news go to stderr: also that the session is paused, when nothing is recorded until it resumes. The\n"
    "recording belongs to the daemon it began with; another one that takes the session's name is never recorded.\n"
    "Exit code 0: --duration or --frames was reached; without either, ended by Ctrl-C, SIGTERM or a shutdown of the\n"
    "session. 130: Ctrl-C or SIGTERM came before the limit. 3: the session ended before the limit, or was lost. 4: the file\n"
    "could not be written. 1: the middleware of this host failed. The file is closed properly and holds what came in each\n"
    "case; --json tells 'complete' and 'ended_by' (limit, interrupt, session, file, middleware, error). At the end it waits\n"
    "up to a second for frames, statistics and inputs that are still being resent. What came reaches the file within a\n"
    "second: 'bleedctl recover' makes a complete file of one that was cut off by kill -9 or a full disk. A disk that is too\n"
    "slow ends the recording, never the session. While what is left waits for such a disk, Ctrl-C gives it up.\n"
    "--quantize 16 halves the file: each attribute of a frame is stored in 65536 steps over its own range, ids stay exact.\n"
    "'bleedctl info' states the largest error. --pointcloud is for Foxglove and Lichtblick; points are never quantised.\n\n";

struct RecordArguments {
  std::string path;
  double duration_s = 0.0;
  std::uint64_t frames = 0;
  double rate_hz = 0.0;
  std::string compression = "zstd";
  int quantize_bits = 0;
  bool point_cloud = false;

  client::RecordingFormat format() const;
};

const std::map<std::string, client::Compression> kCompressions{
    {"none", client::Compression::none}, {"lz4", client::Compression::lz4}, {"zstd", client::Compression::zstd}};

client::RecordingFormat RecordArguments::format() const {
  return {.compression = kCompressions.at(compression), .quantize16 = quantize_bits == 16, .point_cloud = point_cloud};
}

void report(const Context& context, const std::string& path, const client::RecordingProgress& progress,
            const RecordOutcome& outcome) {
  if (context.json) {
    JsonObject json;
    json.add("file", path).add("frames", progress.frames).add("gaps", progress.gaps).add("malformed", progress.malformed);
    json.add("last_particles", progress.particles).add("duration_s", progress.recorded_s).add("bytes", progress.bytes);
    json.add("complete", outcome.problem.empty()).add("ended_by", outcome.ended_by);
    fmt::print("{}\n", json.add("session_gone", progress.session_gone).text());
    return;
  }
  const std::string malformed = progress.malformed > 0 ? fmt::format(", {} malformed", progress.malformed) : std::string{};
  const std::string complete = outcome.problem.empty() ? std::string{} : "; incomplete: " + outcome.problem;
  fmt::print("{}: {} frames, {} gaps{}, {:.3f} s, {} particles, {:.1f} MB{}\n", path, progress.frames, progress.gaps, malformed,
             progress.recorded_s, progress.particles, static_cast<double>(progress.bytes) * 1e-6, complete);
}

void print(const std::string& text) {
  if (!text.empty()) fmt::print(stderr, "{}", text);
}

/// Shows the progress until the recording is done or a signal comes.
void follow(client::Recorder& recorder, RecordNarrator& narrator, const client::RecordingLimits& limits) {
  for (bool interrupted = false; !interrupted && !recorder.progress().done;) {
    interrupted = waitForStopSignal(kTick);
    const client::RecordingProgress progress = recorder.progress();
    print(narrator.news(progress));
    print(narrator.bar(progress, limits));
  }
}

/// Closes the recording. As long as a disk may hang there, a stop signal ends the program: what is in the file stays.
Status close(client::Recorder& recorder, const RecordNarrator& narrator) {
  std::future<Status> closed = std::async(std::launch::async, [&recorder] { return recorder.close(); });
  const std::string failure = recorder.progress().failure;
  if (!failure.empty() || closed.wait_for(kUsualClosing) != std::future_status::ready) {
    endOnStopSignals();
    print(narrator.closing(failure));
  }
  return closed.get();
}

int runRecord(const Context& context, const std::string& path, const client::RecordingLimits& limits,
              const client::RecordingFormat& format) {
  Result<client::Client> client = client::Client::create(context.connection);
  if (!client) return fail(client.status());
  const Result<client::SessionStatus> session = client->find(context.session, context.timeout());
  if (!session) return fail(session.status());
  Result<client::Recorder> recorder = client::Recorder::start(*client, session->name, path, limits, format);
  if (!recorder) return fail(recordExitCode(recorder.status()), recorder.status().message());
  holdStopSignals();  // not before: a disk may hang when the file is opened
  const bool terminal = isatty(STDERR_FILENO) == 1;
  RecordNarrator narrator{session->name, path, terminal};
  follow(*recorder, narrator, limits);
  const Status closed = close(*recorder, narrator);
  const client::RecordingProgress progress = recorder->progress();
  const RecordOutcome outcome = judgeRecording(session->name, progress, limits, closed);
  if (terminal) fmt::print(stderr, "\n");
  report(context, path, progress, outcome);
  if (outcome.code == kDone) return kDone;
  if (outcome.code == kFile) return fail(kFile, fmt::format("{}; 'bleedctl info {}' says what it holds", outcome.problem, path));
  return fail(outcome.code, fmt::format("{}: the recording is incomplete, '{}' holds what came", outcome.problem, path));
}

}  // namespace

void addRecord(CLI::App& app, Context& context) {
  CLI::App* record = app.add_subcommand("record", "Record a session into an MCAP file until a limit or Ctrl-C");
  record->footer(kRecordText + record->get_footer());  // what all commands say follows
  const auto v = std::make_shared<RecordArguments>();
  record->add_option("-o,--output", v->path, "File to write, replaced if it exists")->required()->type_name("FILE");
  CLI::Option* duration = record->add_option("--duration", v->duration_s, "Simulated seconds from the first frame")
                              ->check(finiteIn(1e-9, 1e9))
                              ->type_name("S");
  CLI::Option* frames = record->add_option("--frames", v->frames, "Number of frames")
                            ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40U))
                            ->type_name("N");
  duration->excludes(frames);
  CLI::Option* rate = record->add_option("--rate", v->rate_hz, "Record at most so many frames per simulated second")
                          ->check(finiteIn(1e-9, 1e6))
                          ->type_name("HZ");
  record->add_option("--compress", v->compression, "none, lz4 or zstd")
      ->check(CLI::IsMember{{"none", "lz4", "zstd"}})
      ->capture_default_str()
      ->type_name("HOW");
  record->add_option("--quantize", v->quantize_bits, "Bits of each number of a frame: 16; default: as published")
      ->check(CLI::IsMember{{16}})
      ->type_name("BITS");
  record->add_flag("--pointcloud", v->point_cloud, "Add each frame as a foxglove.PointCloud");
  record->callback([&context, v, duration, frames, rate] {
    client::RecordingLimits limits;
    if (duration->count() > 0) limits.duration_s = v->duration_s;
    if (frames->count() > 0) limits.frames = v->frames;
    if (rate->count() > 0) limits.rate_hz = v->rate_hz;
    context.action = [&context, path = v->path, limits, format = v->format()] {
      return runRecord(context, path, limits, format);
    };
  });
}

}  // namespace bleedsim::bleedctl
