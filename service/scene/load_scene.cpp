#include <fmt/format.h>
#include <fstream>
#include <string>
#include <system_error>

#include "service/scene/scene.h"

namespace bleedsim::scene {
namespace {

constexpr const char* kRemedy = "give the path of a scene file, for example config/scenes/round_wound.textproto";

Status failure(StatusCode code, const std::filesystem::path& path, const std::string& what) {
  return {code, fmt::format("scene file '{}': {}", path.string(), what)};
}

Result<std::string> readFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    return failure(StatusCode::not_found, path, fmt::format("does not exist; {}", kRemedy));
  }
  if (status.type() == std::filesystem::file_type::none) {
    return failure(StatusCode::io, path,
                   fmt::format("cannot be examined ({}); check the permissions of its folders", error.message()));
  }
  if (status.type() == std::filesystem::file_type::directory) {
    return failure(StatusCode::invalid_argument, path, fmt::format("is a folder; {}", kRemedy));
  }
  if (status.type() != std::filesystem::file_type::regular) {
    return failure(StatusCode::invalid_argument, path, fmt::format("is not a regular file; {}", kRemedy));
  }
  std::ifstream file{path, std::ios::binary};
  if (!file) return failure(StatusCode::io, path, "cannot be opened; check its permissions");
  // One byte beyond the limit tells a file that is too large, even if it grows while it is read.
  std::string text(kMaxSceneBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return failure(StatusCode::io, path, "cannot be read to its end; check the disk");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxSceneBytes) {
    return failure(StatusCode::invalid_argument, path, fmt::format("is larger than {} bytes; is it a scene?", kMaxSceneBytes));
  }
  return text;
}

}  // namespace

Result<SceneDescription> loadScene(const std::filesystem::path& path) {
  const Result<std::string> text = readFile(path);
  if (!text) return text.status();
  Result<SceneDescription> scene = parseScene(*text);
  if (!scene) return failure(scene.status().code(), path, scene.status().message());
  return scene;
}

}  // namespace bleedsim::scene
