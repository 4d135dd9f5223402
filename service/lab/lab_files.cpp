#include "service/lab/lab_files.h"

#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <nlohmann/json.hpp>

namespace bleedsim::lab {
namespace {

constexpr picture::PlotOptions kSmall{.width = 720, .height = 480};

Status writeFile(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file{path, std::ios::binary | std::ios::trunc};
  file << text;
  file.close();
  if (!file) return {StatusCode::io, "cannot write '" + path.string() + "'; check the folder and the disk"};
  fmt::print(stderr, "wrote {}\n", path.string());
  return {};
}

template <class Plot>
Status write(const std::string& folder, const std::string& name, const Plot& plot, std::string& picture) {
  const auto files = picture::writePlot(folder, name, plot, kSmall);
  if (!files) return files.status();
  picture = files->drawn ? files->png.filename().string() : std::string{};
  if (!files->advice.empty()) fmt::print(stderr, "{}\n", files->advice);
  return {};
}

}  // namespace

Status makeFolder(const std::string& folder) {
  if (folder.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder, error)) return {};
  return {StatusCode::io, "cannot make folder '" + folder + "': " + (error ? error.message() : "it is a file")};
}

Status writeTextFile(const std::string& folder, const std::string& name, const std::string& text) {
  return writeFile(std::filesystem::path{folder} / name, text);
}

Status writeSmallPlot(const std::string& folder, const std::string& name, const picture::LinePlot& plot, std::string& picture) {
  return write(folder, name, plot, picture);
}

Status writeSmallPlot(const std::string& folder, const std::string& name, const picture::BarPlot& plot, std::string& picture) {
  return write(folder, name, plot, picture);
}

Status writeJson(const std::string& path, const nlohmann::json& json) {
  if (path.empty()) return {};
  if (path == "-") {
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  return writeFile(path, json.dump(2) + "\n");
}

}  // namespace bleedsim::lab
