#include "service/lab/hardcases/every_effect.h"

namespace bleedsim::lab {
namespace {

template <class Settings>
void addIfMissing(std::optional<Settings>& effect) {
  if (!effect) effect.emplace();
}

constexpr double kContactAngle = 0.7;  // rad, blood on tissue

}  // namespace

void addEveryEffect(sph::WorldDescription& scene) {
  sph::EffectSettings& effects = scene.effects;
  const bool sound = scene.model == sph::Model::sound;
  addIfMissing(effects.gravity);
  addIfMissing(effects.pressure);
  addIfMissing(effects.viscosity);
  addIfMissing(effects.platelets);
  addIfMissing(effects.core_radius);
  addIfMissing(effects.repulsion);
  addIfMissing(effects.applied_force);
  if (!scene.planar && !effects.surface_tension) {
    effects.surface_tension.emplace();
    if (sound && !scene.tissue.empty()) effects.surface_tension->contact_angle = kContactAngle;
  }
  if (sound && !scene.tissue.empty()) addIfMissing(effects.adhesion);
}

}  // namespace bleedsim::lab
