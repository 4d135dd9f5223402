#include "service/daemon/scene_loader.h"

#include <algorithm>
#include <exception>
#include <spdlog/spdlog.h>
#include <utility>

#include "service/build/build_info.h"
#include "service/checkpoint/rebuild.h"

namespace bleedsim::daemon {
namespace {

/// Into the log, those that were not there before.
void tellWarnings(const scene::SceneDescription& scene, const std::vector<std::string>& before) {
  for (const std::string& warning : scene.warnings) {
    if (std::find(before.begin(), before.end(), warning) == before.end()) spdlog::warn("{}", warning);
  }
}

Result<LoadedScene> buildSwitched(const SceneJob& job, sph::WorldOptions options) {
  const scene::Session& session = job.effect->session;
  Result<scene::SceneDescription> changed = job.effect->change ? scene::changeEffect(*job.known, *job.effect->change, session)
                                                               : scene::decideAgain(*job.known, session);
  if (!changed) return changed.status();
  tellWarnings(*changed, job.known->warnings);
  options.speed_of_sound = session.speed_of_sound;
  Result<std::unique_ptr<sph::World>> world = sph::createWorld(changed->world, options);
  if (!world) return world.status();
  return LoadedScene{std::make_shared<const scene::SceneDescription>(std::move(*changed)), std::move(*world), {}};
}

Result<LoadedScene> buildFrom(const checkpoint::Folder& checkpoints, const std::string& name, const sph::WorldOptions& options) {
  Result<checkpoint::Checkpoint> read = checkpoints.read(name);
  if (!read) return read.status();
  Result<checkpoint::Rebuilt> rebuilt = checkpoint::rebuild(*read, options, buildId());
  if (!rebuilt) return checkpoint::aboutCheckpoint(name, rebuilt.status());
  FrameMailbox::Buffers frames = FrameMailbox::makeBuffers(rebuilt->scene->world.capacity);
  return LoadedScene{std::move(rebuilt->scene), std::move(rebuilt->world), std::move(frames),
                     RestoredSession{std::move(rebuilt->loaded), std::move(read->head)}};
}

/// The newest one that can be gone on from.
Result<LoadedScene> buildFromNewest(const checkpoint::Folder& checkpoints, const sph::WorldOptions& options) {
  std::string newest;
  for (const checkpoint::Entry& entry : checkpoints.list()) {
    Result<LoadedScene> loaded =
        entry.readable ? buildFrom(checkpoints, entry.name, options) : checkpoint::aboutCheckpoint(entry.name, entry.readable);
    if (loaded) return loaded;
    if (newest.empty()) newest = loaded.status().message();
    spdlog::warn("skipped {}", loaded.status().message());
  }
  if (newest.empty()) return Status{StatusCode::not_found, "there are no checkpoints yet"};
  return Status{StatusCode::data_loss, "no checkpoint can be used; " + newest};
}

Result<LoadedScene> build(const SceneJob& job, const sph::WorldOptions& options, const checkpoint::Folder* checkpoints) {
  if (job.effect) return buildSwitched(job, options);
  if (job.checkpoint && checkpoints == nullptr) return Status{StatusCode::wrong_state, "there is no folder of checkpoints"};
  if (job.checkpoint && !job.checkpoint->empty()) return buildFrom(*checkpoints, *job.checkpoint, options);
  if (job.checkpoint) return buildFromNewest(*checkpoints, options);
  std::shared_ptr<const scene::SceneDescription> description = job.known;
  if (!description) {
    Result<scene::SceneDescription> parsed = scene::parseScene(job.text);
    if (!parsed) {
      // Of all problems a reply has room for the first only.
      spdlog::warn("load_scene refused: {}", parsed.status().message());
      return parsed.status();
    }
    tellWarnings(*parsed, {});
    description = std::make_shared<const scene::SceneDescription>(std::move(*parsed));
  }
  Result<std::unique_ptr<sph::World>> world = sph::createWorld(description->world, options);
  if (!world) return world.status();
  FrameMailbox::Buffers frames = FrameMailbox::makeBuffers(description->world.capacity);
  return LoadedScene{std::move(description), std::move(*world), std::move(frames)};
}

}  // namespace

SceneFactory worldFactory(sph::WorldOptions options, std::shared_ptr<const checkpoint::Folder> checkpoints) {
  return [options, checkpoints = std::move(checkpoints)](const SceneJob& job) -> Result<LoadedScene> {
    // A scene may ask for more memory than there is; the session must outlive that.
    try {
      return build(job, options, checkpoints.get());
    } catch (const std::exception& failure) {
      return Status{StatusCode::internal,
                    std::string{"the scene could not be built ("} + failure.what() + "): use a smaller capacity or domain"};
    }
  };
}

void SceneLoader::start(SceneJob job) {
  thread_ = std::thread{[this, before = std::move(thread_), job = std::move(job)]() mutable {
    if (before.joinable()) before.join();
    Result<LoadedScene> loaded = factory_(job);
    {
      const std::lock_guard lock{mutex_};
      finished_.emplace(std::move(loaded));
    }
    done_.notify();
  }};
}

void SceneLoader::retire(std::unique_ptr<sph::World> world) {
  thread_ = std::thread{[before = std::move(thread_), world = std::move(world)]() mutable {
    if (before.joinable()) before.join();
    world.reset();
  }};
}

std::optional<Result<LoadedScene>> SceneLoader::takeFinished() {
  std::optional<Result<LoadedScene>> out;
  {
    const std::lock_guard lock{mutex_};
    out.swap(finished_);
  }
  if (out) join();
  return out;
}

}  // namespace bleedsim::daemon
