#include "service/lab/paper/model_choice.h"

#include "service/lab/paper/paper_scene.h"

namespace bleedsim::lab {

std::vector<ModelFace> facesOf(ModelChoice choice) {
  std::vector<ModelFace> faces;
  if (choice != ModelChoice::literal) faces.push_back({"sound", false});
  if (choice != ModelChoice::sound) faces.push_back({"literal", true});
  return faces;
}

Result<sph::WorldDescription> loadFace(const PaperOptions& options, std::string_view experiment, const ModelFace& face) {
  auto scene = loadPaperScene(options, std::string{experiment} + (face.literal ? "_literal" : ""));
  if (!scene) return scene.status();
  const sph::Model wanted = face.literal ? sph::Model::literal : sph::Model::sound;
  if (scene->world.model != wanted) {
    return Status{StatusCode::invalid_argument,
                  "scene '" + scene->name + "' must have model: " + (face.literal ? "LITERAL" : "SOUND")};
  }
  return scene->world;
}

}  // namespace bleedsim::lab
