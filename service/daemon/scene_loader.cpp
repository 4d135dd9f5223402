#include "service/daemon/scene_loader.h"

#include <exception>
#include <utility>

namespace bleedsim::daemon {
namespace {

Result<LoadedScene> buildSwitched(const SceneJob& job, sph::WorldOptions options) {
  Result<scene::SceneDescription> changed = scene::changeEffect(*job.known, job.effect->change, job.effect->speed_of_sound);
  if (!changed) return changed.status();
  options.speed_of_sound = job.effect->speed_of_sound;
  Result<std::unique_ptr<sph::World>> world = sph::createWorld(changed->world, options);
  if (!world) return world.status();
  return LoadedScene{std::make_shared<const scene::SceneDescription>(std::move(*changed)), std::move(*world), {}};
}

Result<LoadedScene> build(const SceneJob& job, const sph::WorldOptions& options) {
  if (job.effect) return buildSwitched(job, options);
  std::shared_ptr<const scene::SceneDescription> description = job.known;
  if (!description) {
    Result<scene::SceneDescription> parsed = scene::parseScene(job.text);
    if (!parsed) return parsed.status();
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
  join();
  thread_ = std::thread{[this, job = std::move(job)] {
    Result<LoadedScene> loaded = factory_(job);
    {
      const std::lock_guard lock{mutex_};
      finished_.emplace(std::move(loaded));
    }
    done_.notify();
  }};
}

void SceneLoader::retire(std::unique_ptr<sph::World> world) {
  join();
  thread_ = std::thread{[world = std::move(world)]() mutable { world.reset(); }};
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
