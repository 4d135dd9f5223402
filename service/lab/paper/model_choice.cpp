#include "service/lab/paper/model_choice.h"

namespace bleedsim::lab {

std::vector<ModelFace> facesOf(ModelChoice choice) {
  std::vector<ModelFace> faces;
  if (choice != ModelChoice::literal) faces.push_back({"sound", false});
  if (choice != ModelChoice::sound) faces.push_back({"literal", true});
  return faces;
}

Result<sph::WorldDescription> inModel(const sph::WorldDescription& scene, const ModelFace& face) {
  if (face.literal) return Status{StatusCode::unsupported, "this build has no literal model"};
  return scene;
}

}  // namespace bleedsim::lab
