// Builds worlds on a thread of its own, while the simulation thread waits in the loading state.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "service/checkpoint/folder.h"
#include "service/daemon/frame_mailbox.h"
#include "service/daemon/wakeup.h"
#include "service/scene/change_effect.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::daemon {

/// Of a scene that goes on from a checkpoint.
struct RestoredSession {
  std::shared_ptr<const scene::SceneDescription> loaded;  ///< as the epoch began with it
  checkpoint::Head head;
};

/// A scene that is ready to run.
struct LoadedScene {
  std::shared_ptr<const scene::SceneDescription> scene;
  std::unique_ptr<sph::World> world;
  FrameMailbox::Buffers frames;
  std::optional<RestoredSession> restored = {};
};

/// What of a running scene is to be switched: an effect by request, or what effects.auto decides now that the session knows more.
struct EffectJob {
  std::optional<scene::EffectChange> change;
  scene::Session session;
};

/// What to build: a scene's text, a known scene from its start, a known scene with other effects, or a checkpoint.
struct SceneJob {
  std::string text;
  std::shared_ptr<const scene::SceneDescription> known;  ///< instead of the text
  std::optional<EffectJob> effect = {};                  ///< of `known`; the outcome has no frames, those of the old world fit
  std::optional<std::string> checkpoint = {};            ///< its name; empty: the newest one that is good
};

/// Runs on the loader's thread. invalid_argument: the scene has problems.
using SceneFactory = std::function<Result<LoadedScene>(const SceneJob&)>;

/// The factory of the daemon: scene::parseScene and sph::createWorld. All problems of a text go to the log, and checkpoints that
/// were passed over. Without a folder there are no checkpoints.
SceneFactory worldFactory(sph::WorldOptions options, std::shared_ptr<const checkpoint::Folder> checkpoints = {});

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
