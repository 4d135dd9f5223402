#include "service/lab/paper/paper_scene.h"

#include <filesystem>
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

}  // namespace bleedsim::lab
