#include "service/lab/paper/model_choice.h"

namespace bleedsim::lab {

std::vector<ModelFace> facesOf(ModelChoice choice) {
  std::vector<ModelFace> faces;
  if (choice != ModelChoice::literal) faces.push_back({"sound", false});
  if (choice != ModelChoice::sound) faces.push_back({"literal", true});
  return faces;
}

sph::WorldDescription inModel(const sph::WorldDescription& scene, const ModelFace& face) {
  sph::WorldDescription world = scene;
  world.model = face.literal ? sph::Model::literal : sph::Model::sound;
  if (face.literal) world.effects.core_radius.reset();
  return world;
}

}  // namespace bleedsim::lab
