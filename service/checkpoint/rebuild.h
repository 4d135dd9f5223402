// From a checkpoint back to a scene and its world.
#pragma once

#include <memory>
#include <string>

#include "service/checkpoint/checkpoint.h"
#include "service/scene/scene.h"
#include "service/sph/world.h"

namespace bleedsim::checkpoint {

struct Rebuilt {
  std::shared_ptr<const scene::SceneDescription> scene;   ///< as it acted
  std::shared_ptr<const scene::SceneDescription> loaded;  ///< as the epoch began with it
  std::unique_ptr<sph::World> world;
};

/// Whether this build can go on with the checkpoint bit for bit. unsupported: why not.
Status checkOrigin(const Head& head, const std::string& build_id, sph::SimdTarget simd);

/// The world in the state of the checkpoint. `options` say threads and, unless it is automatic, the SIMD target; that of the
/// checkpoint is used otherwise. Allocates and takes long. unsupported: of another build or target; data_loss: the state is
/// damaged; else as sph::createWorld.
Result<Rebuilt> rebuild(const Checkpoint& checkpoint, const sph::WorldOptions& options, const std::string& build_id);

}  // namespace bleedsim::checkpoint
