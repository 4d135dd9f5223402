// Builds worlds on a thread of its own, while the simulation thread waits in the loading state.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "service/daemon/frame_mailbox.h"
#include "service/daemon/wakeup.h"
#include "service/scene/change_effect.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::daemon {

/// A scene that is ready to run.
struct LoadedScene {
  std::shared_ptr<const scene::SceneDescription> scene;
  std::unique_ptr<sph::World> world;
  FrameMailbox::Buffers frames;
};

/// What of a running scene is to be switched: an effect by request, or what effects.auto decides now that the session knows more.
struct EffectJob {
  std::optional<scene::EffectChange> change;
  scene::Session session;
};

/// What to build: a scene's text, a known scene from its start, or a known scene with other effects.
struct SceneJob {
  std::string text;
  std::shared_ptr<const scene::SceneDescription> known;  ///< instead of the text
  std::optional<EffectJob> effect = {};                  ///< of `known`; the outcome has no frames, those of the old world fit
};

/// Runs on the loader's thread. invalid_argument: the scene has problems.
using SceneFactory = std::function<Result<LoadedScene>(const SceneJob&)>;

/// The factory of the daemon: scene::parseScene and sph::createWorld. All problems of a text go to the log.
SceneFactory worldFactory(sph::WorldOptions options);

/// One job at a time, in order. Neither start() nor retire() waits for the one before.
class SceneLoader {
 public:
  /// `done` is notified when a job has ended.
  SceneLoader(SceneFactory factory, Wakeup& done) : factory_{std::move(factory)}, done_{done} {}
  ~SceneLoader() { join(); }
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  void start(SceneJob job);
  /// Frees a world on the loader's thread.
  void retire(std::unique_ptr<sph::World> world);
  /// The outcome of the job once it has ended.
  std::optional<Result<LoadedScene>> takeFinished();

 private:
  void join() {
    if (thread_.joinable()) thread_.join();
  }

  SceneFactory factory_;
  Wakeup& done_;
  std::thread thread_;
  std::mutex mutex_;
  std::optional<Result<LoadedScene>> finished_;
};

}  // namespace bleedsim::daemon
