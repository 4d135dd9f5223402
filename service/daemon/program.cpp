#include "service/daemon/program.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <utility>

#include "service/daemon/inspect.h"
#include "service/daemon/service.h"

namespace bleedsim::daemon {
namespace {

void logStart(const ServiceOptions& options, const Service& service, const scene::SceneDescription& scene,
              std::string_view simd) {
  const dds::SessionIdentity& identity = service.identity();
  spdlog::info("bleedd {} runs session '{}' ({}) in domain {}", identity.version, identity.name,
               transport::toString(identity.uuid), options.participant.domain);
  if (const auto config = transport::chooseConfig(options.participant)) {
    spdlog::info("DDS uses {}", transport::describe(*config));
    if (config->kind == transport::ConfigKind::user && !options.participant.interface.empty()) {
      spdlog::warn("--interface {} is not used: CYCLONEDDS_URI replaces it", options.participant.interface);
    }
  }
  spdlog::info("scene '{}', capacity {} particles, SIMD target {}", scene.name, scene.world.capacity, simd);
  for (const std::string& warning : scene.warnings) spdlog::warn("{}", warning);
}

void reopen(const std::shared_ptr<LogFile>& log_file) {
  if (!log_file) {
    spdlog::info("SIGHUP: there is no log file to reopen");
    return;
  }
  if (const Status opened = log_file->reopen(); !opened) {
    spdlog::error("{}; the log goes on in the old file", opened.message());
    return;
  }
  spdlog::info("log file reopened");
}

/// Of a service that could not start or did not end as asked.
ExitCode exitCodeOf(const Status& status) {
  if (status.code() == StatusCode::unavailable) return ExitCode::name_taken;
  return status.code() == StatusCode::invalid_argument ? ExitCode::usage : ExitCode::failure;
}

/// The newest good checkpoint in place of the scene, if there is one. `duration` in s.
void resume(const SceneFactory& factory, const std::string& folder, std::optional<double> duration, LoadedScene& loaded) {
  SceneJob newest;
  newest.checkpoint.emplace();
  Result<LoadedScene> resumed = factory(newest);
  if (!resumed) {
    spdlog::warn("nothing to resume from in '{}': {}; the scene starts from its beginning", folder, resumed.status().message());
    return;
  }
  const checkpoint::Head& head = resumed->restored->head;
  if (head.loaded_text != loaded.scene->normalized_text) {
    spdlog::warn("checkpoint '{}' is of another scene than --scene: it goes on, '{}'", head.name, resumed->scene->name);
  }
  spdlog::info("resumed from checkpoint '{}': step {}, {:.3f} s of epoch {}{}", head.name, head.mark.step, head.mark.sim_time,
               head.mark.epoch, head.mark.paused ? ", paused" : "");
  if (duration && head.mark.sim_time >= *duration) {
    spdlog::warn("nothing is left to run: --duration is {} s, and that checkpoint is as late; give a longer one to go on",
                 *duration);
  }
  loaded = std::move(*resumed);
}

ExitCode runService(const Options& options, LoadedScene loaded, SceneFactory factory,
                    std::shared_ptr<checkpoint::Folder> checkpoints, const std::shared_ptr<LogFile>& log_file,
                    SignalWatch& signals) {
  const std::shared_ptr<const scene::SceneDescription> scene = loaded.scene;
  const std::string_view simd = sph::simdTargetName(loaded.world->simdTarget());
  ServiceOptions service_options;
  service_options.participant.domain = options.domain;
  service_options.participant.interface = options.interface;
  service_options.session = options.session;
  service_options.simulation = {options.pace, options.frame_rate, options.duration};
  service_options.simulation.checkpoint_every = options.checkpoint_every;
  service_options.checkpoints = std::move(checkpoints);
  service_options.manager = findServiceManager();
  Result<std::unique_ptr<Service>> service = Service::create(service_options, std::move(loaded), std::move(factory));
  if (!service) {
    spdlog::error("{}", service.status().message());
    return exitCodeOf(service.status());
  }
  logStart(service_options, **service, *scene, simd);
  const auto end = [&service] {
    spdlog::info("asked to end");
    (*service)->requestStop();
  };
  // Without a file nor a service manager, SIGHUP means that the terminal is gone.
  const bool stays = log_file != nullptr || service_options.manager.tell != nullptr;
  signals.start({end, stays ? [&log_file] { reopen(log_file); } : std::function<void()>{}});
  const Status ended = (*service)->run();
  signals.stop();
  if (ended) {
    spdlog::info("ended");
    return ExitCode::ok;
  }
  spdlog::error("{}", ended.message());
  return exitCodeOf(ended);
}

}  // namespace

ExitCode runProgram(const Options& options, const std::shared_ptr<LogFile>& log_file, SignalWatch& signals) {
  if (!options.scene) {
    fmt::print("{}", listEffects(nullptr, options.json));
    return ExitCode::ok;
  }
  Result<scene::SceneDescription> parsed = scene::loadScene(*options.scene);
  if (!parsed) {
    spdlog::error("{}", parsed.status().message());
    return ExitCode::usage;
  }
  if (options.list_effects) {
    fmt::print("{}", listEffects(&*parsed, options.json));
    return ExitCode::ok;
  }
  std::shared_ptr<checkpoint::Folder> checkpoints;
  if (options.checkpoint_folder && !options.check) {
    Result<checkpoint::Folder> folder = checkpoint::Folder::open(*options.checkpoint_folder);
    if (!folder) {
      spdlog::error("{}", folder.status().message());
      return folder.status().code() == StatusCode::unavailable ? ExitCode::name_taken : ExitCode::usage;
    }
    checkpoints = std::make_shared<checkpoint::Folder>(std::move(*folder));
  }
  const SceneFactory factory = worldFactory(options.world, checkpoints);
  Result<LoadedScene> loaded = factory({{}, std::make_shared<const scene::SceneDescription>(std::move(*parsed))});
  if (!loaded) {
    spdlog::error("{}: {}", *options.scene, loaded.status().message());
    return ExitCode::usage;
  }
  if (options.check) {
    fmt::print("{}", describeWorld(*loaded));
    return ExitCode::ok;
  }
  if (options.resume) resume(factory, *options.checkpoint_folder, options.duration, *loaded);
  return runService(options, std::move(*loaded), factory, std::move(checkpoints), log_file, signals);
}

}  // namespace bleedsim::daemon
