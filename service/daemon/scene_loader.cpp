#include "service/daemon/scene_loader.h"

#include <algorithm>
#include <exception>
#include <spdlog/spdlog.h>
#include <utility>

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

Result<LoadedScene> build(const SceneJob& job, const sph::WorldOptions& options) {
  if (job.effect) return buildSwitched(job, options);
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

SceneFactory worldFactory(sph::WorldOptions options) {
  return [options](const SceneJob& job) -> Result<LoadedScene> {
    // A scene may ask for more memory than there is; the session must outlive that.
    try {
      return build(job, options);
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
