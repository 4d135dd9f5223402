#include "service/daemon/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>

#include "service/build/build_info.h"
#include "service/dds/command_limits.h"
#include "service/status/number_text.h"
#include "service/status/pace_text.h"
#include "service/transport/domain.h"
#include "service/transport/names.h"

namespace bleedsim::daemon {
namespace {

constexpr int kMaxThreads = 64;
constexpr int kMaxDefaultThreads = 8;
constexpr double kMaxDuration = 1e9;
constexpr double kMinCheckpointInterval = 0.001;

constexpr const char* kFooter =
    "Exit codes:\n"
    "  0  ended as asked: by a shutdown request, --duration, SIGINT or SIGTERM\n"
    "  1  failure of the network (an interface that is missing or down) or the system, or ended at once by a second SIGINT or "
    "SIGTERM\n"
    "  2  wrong command line, domain, log file or scene: trying again does not help\n"
    "  3  another bleedd runs a session of this name\n"
    "SIGHUP opens --log-file anew, for tools that rotate logs. Without a log file and a service manager it is as SIGTERM.\n"
    "A solver that stops on bad numbers does not end bleedd: the session is then 'faulted' until a reset or another scene.\n"
    "Without --interface only this host can take part. With CYCLONEDDS_URI set, that configuration is used as it is.";

int defaultThreads() { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMaxDefaultThreads); }

/// What CLI11 expects of a validator: the empty text, or what is wrong.
std::string textOf(const Status& status) { return status.message(); }

/// Empty: nothing says where.
std::string defaultCheckpointDir() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string{value == nullptr ? "" : value};
  };
  // systemd's may list several.
  if (const std::string state = variable("STATE_DIRECTORY"); !state.empty()) return state.substr(0, state.find(':'));
  if (const std::string state = variable("XDG_STATE_HOME"); !state.empty()) return state + "/bleedsim";
  const std::string home = variable("HOME");
  return home.empty() ? home : home + "/.local/state/bleedsim";
}

}  // namespace

std::variant<Options, ExitCode> parseOptions(int argc, const char* const* argv) {
  Options options;
  options.session = transport::kDefaultSession;
  options.world.threads = defaultThreads();
  std::string scene;
  std::string pace = "realtime";
  std::string simd = "auto";
  double frame_rate = 0.0;
  double duration = 0.0;
  double checkpoint_every = 0.0;
  std::string checkpoint_dir;
  std::string log_file_path;

  CLI::App app{"bleedd simulates a bleeding scene and publishes it over DDS", "bleedd"};
  app.footer(kFooter);
  app.set_version_flag("--version", buildId(), "Print version and build, then exit");
  app.add_option("--scene", scene, "Scene to run, protobuf text")->type_name("FILE");
  app.add_option("--session", options.session, "Name that clients find the session by, also its partition")
      ->check([](const std::string& name) { return textOf(transport::checkSessionName(name)); })
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(std::uint32_t{0}, transport::kMaxDomain))
      ->capture_default_str();
  app.add_option("--interface", options.interface, "Network interface to publish on; without it, loopback only")
      ->type_name("NAME");
  app.add_option("--pace", pace, "realtime, max, or simulated seconds per second")
      ->check([](const std::string& text) { return textOf(parsePace<dds::Pace>(text).status()); })
      ->type_name("PACE")
      ->capture_default_str();
  auto* rate_option = app.add_option("--frame-rate", frame_rate, "Frames per simulated second; without it, the scene's")
                          ->check(finiteIn(dds::kFrameRateRange.lower, dds::kFrameRateRange.upper))
                          ->type_name("HZ");
  app.add_option("--threads", options.world.threads, "Threads of the solver; results do not depend on it")
      ->check(CLI::Range(1, kMaxThreads))
      ->capture_default_str();
  app.add_option("--simd", simd, "Instruction set of the solver: auto, scalar, avx2 or avx512")
      ->check([](const std::string& name) { return textOf(sph::parseSimdTarget(name).status()); })
      ->type_name("TARGET")
      ->capture_default_str();
  auto* duration_option =
      app.add_option("--duration", duration,
                     "End once the simulated time has reached this; with --resume, what the session ran before "
                     "counts, so that it ends where it would have without the kill")
          ->check(finiteIn(0.0, kMaxDuration))
          ->type_name("SECONDS");
  auto* every_option =
      app.add_option(
             "--checkpoint-every", checkpoint_every,
             "Keep the whole state every so many simulated seconds, the last 3 of them, for --resume and restore requests")
          ->check(finiteIn(kMinCheckpointInterval, kMaxDuration))
          ->type_name("SECONDS");
  auto* dir_option = app.add_option("--checkpoint-dir", checkpoint_dir,
                                    "Folder of checkpoints, in which each session has its own; without it $STATE_DIRECTORY, "
                                    "$XDG_STATE_HOME/bleedsim or ~/.local/state/bleedsim")
                         ->type_name("DIR");
  app.add_flag("--resume", options.resume,
               "Go on from the newest checkpoint that is good, as after a kill; without one, start the scene")
      ->disable_flag_override();
  app.add_option("--log-level", options.log.level, "trace, debug, info, warning, error or off")
      ->check([](const std::string& level) { return textOf(checkLogLevel(level)); })
      ->type_name("LEVEL")
      ->capture_default_str();
  auto* log_file =
      app.add_option("--log-file", log_file_path, "Append the log to FILE; stderr then shows warnings and errors only")
          ->type_name("FILE");
  app.add_flag("--check", options.check, "Check the scene, build its world and exit")->disable_flag_override();
  auto* list = app.add_flag("--list-effects", options.list_effects,
                            "List the effects of this build: equation, source, deviation from the paper; with a scene, also "
                            "their state in it, decisions of effects.auto and warnings")
                   ->disable_flag_override();
  app.add_flag("--json", options.json, "List the effects as JSON")->needs(list)->disable_flag_override();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& ended) { return app.exit(ended, std::cout, std::cerr) == 0 ? ExitCode::ok : ExitCode::usage; }
  if (!scene.empty()) options.scene = scene;
  if (!options.scene && !options.list_effects) {
    std::cerr << "bleedd: which scene? Give --scene FILE, e.g. one of config/scenes; see bleedd --help\n";
    return ExitCode::usage;
  }
  if (rate_option->count() > 0) options.frame_rate = frame_rate;
  if (duration_option->count() > 0) options.duration = duration;
  if (log_file->count() > 0) options.log.file = log_file_path;
  if (every_option->count() > 0) options.checkpoint_every = checkpoint_every;
  if (every_option->count() > 0 || dir_option->count() > 0 || options.resume) {
    if (dir_option->count() == 0) checkpoint_dir = defaultCheckpointDir();
    if (checkpoint_dir.empty()) {
      std::cerr << "bleedd: where are checkpoints to be kept? Give --checkpoint-dir DIR; see bleedd --help\n";
      return ExitCode::usage;
    }
    options.checkpoint_folder = (std::filesystem::path{checkpoint_dir} / options.session).string();
  }
  options.pace = *parsePace<dds::Pace>(pace);
  options.world.simd = *sph::parseSimdTarget(simd);
  return options;
}

}  // namespace bleedsim::daemon
