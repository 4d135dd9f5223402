#include "service/checkpoint/rebuild.h"

#include <fmt/core.h>

#include "service/scene/change_effect.h"

namespace bleedsim::checkpoint {
namespace {

Status mismatch(const char* what, const std::string& saved, const std::string& here) {
  return {StatusCode::unsupported, fmt::format("it is of {} '{}', this is '{}'", what, saved, here)};
}

}  // namespace

Status checkOrigin(const Head& head, const std::string& build_id, sph::SimdTarget simd) {
  if (head.build_id != build_id) return mismatch("build", head.build_id, build_id);
  if (simd != sph::SimdTarget::automatic && head.simd_target != sph::simdTargetName(simd)) {
    return mismatch("SIMD target", head.simd_target, std::string{sph::simdTargetName(simd)});
  }
  return {};
}

Result<Rebuilt> rebuild(const Checkpoint& checkpoint, const sph::WorldOptions& options, const std::string& build_id) {
  const Head& head = checkpoint.head;
  if (Status origin = checkOrigin(head, build_id, options.simd); !origin) return origin;
  const Result<sph::SimdTarget> target = sph::parseSimdTarget(head.simd_target);
  if (!target || *target == sph::SimdTarget::automatic) {
    return Status{StatusCode::data_loss, fmt::format("its SIMD target is '{}'", head.simd_target)};
  }
  if (head.precision != "float32" && head.precision != "float64") {
    return Status{StatusCode::data_loss, fmt::format("its precision is '{}'", head.precision)};
  }
  Result<scene::SceneDescription> loaded = scene::parseScene(head.loaded_text);
  if (!loaded) return loaded.status();
  Result<scene::SceneDescription> scene =
      scene::reopenScene(head.scene_text, head.former_settings, {head.mark.speed_of_sound, head.decided_for_wound});
  if (!scene) return scene.status();
  sph::WorldOptions world_options = options;
  world_options.simd = *target;
  world_options.precision = head.precision == "float32" ? sph::Precision::float32 : sph::Precision::float64;
  world_options.speed_of_sound = head.mark.speed_of_sound;
  Result<std::unique_ptr<sph::World>> world = sph::createWorld(scene->world, world_options);
  if (!world) return world.status();
  if (Status restored = (*world)->restoreState(checkpoint.state); !restored) return restored;
  const sph::World& restored = **world;
  if (restored.stateHash() != head.mark.state_hash || restored.stepCount() != head.mark.step) {
    return Status{StatusCode::data_loss, "its state is not the one that its head tells of"};
  }
  return Rebuilt{std::make_shared<const scene::SceneDescription>(std::move(*scene)),
                 std::make_shared<const scene::SceneDescription>(std::move(*loaded)), std::move(*world)};
}

}  // namespace bleedsim::checkpoint
