#include "service/lab/paper/paper_scene.h"

#include <cmath>
#include <filesystem>
#include <variant>
#include <vector>

namespace bleedsim::lab {
namespace {

std::vector<std::filesystem::path> foldersOf(const PaperOptions& options) {
  if (!options.scenes.empty()) return {options.scenes};
  return {"config/scenes/paper", BLEEDSIM_PAPER_SCENES};
}

}  // namespace

Result<scene::SceneDescription> loadPaperScene(const PaperOptions& options, std::string_view name) {
  const std::string file = std::string{name} + ".textproto";
  std::string tried;
  for (const std::filesystem::path& folder : foldersOf(options)) {
    std::error_code error;
    if (std::filesystem::exists(folder / file, error)) return scene::loadScene(folder / file);
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  return Status{StatusCode::not_found, "no scene '" + file + "' in " + tried + "; name its folder with --scenes"};
}

Result<double> horizonOf(const scene::SceneDescription& scene) {
  if (scene.horizon) return *scene.horizon;
  return Status{StatusCode::invalid_argument, "scene '" + scene.name + "' needs horizon_s: how long the experiment lasts"};
}

Result<std::uint32_t> particlesOf(const scene::SceneDescription& scene) {
  const auto horizon = horizonOf(scene);
  if (!horizon) return horizon.status();
  double flow = 0.0;
  for (const sph::WoundDescription& wound : scene.world.wounds) {
    const auto* drive = std::get_if<sph::FlowDrive>(&wound.drive);
    if (drive == nullptr) {
      return Status{StatusCode::invalid_argument,
                    "scene '" + scene.name + "' has a wound without flow_ml_per_s; say how many particles with --particles"};
    }
    flow += drive->flow;
  }
  return static_cast<std::uint32_t>(std::lround(*horizon * flow / scene.world.particleVolume()));
}

}  // namespace bleedsim::lab
