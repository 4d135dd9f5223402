#include "service/lab/paper/paper_files.h"

#include <filesystem>
#include <fmt/core.h>
#include <fstream>

#include "service/picture/png_file.h"

namespace bleedsim::lab {
namespace {

void tell(const std::filesystem::path& path) { fmt::print(stderr, "wrote {}\n", path.string()); }

Status writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file{path, std::ios::binary | std::ios::trunc};
  file << text;
  file.close();
  if (!file) return {StatusCode::io, "cannot write '" + path.string() + "'; check the folder and the disk"};
  tell(path);
  return {};
}

}  // namespace

Status writePicture(const PaperOptions& options, const std::string& name, const picture::Image& image) {
  if (options.folder.empty()) return {};
  const std::filesystem::path path = std::filesystem::path{options.folder} / (name + ".png");
  if (Status status = picture::writePng(path, image); !status.ok()) return status;
  tell(path);
  return {};
}

Status writeLinePlot(const PaperOptions& options, const std::string& name, const picture::LinePlot& plot) {
  if (options.folder.empty()) return {};
  const auto files = picture::writePlot(options.folder, name, plot);
  if (!files) return files.status();
  tell(files->csv);
  if (files->drawn) tell(files->png);
  if (!files->advice.empty()) fmt::print(stderr, "{}\n", files->advice);
  return {};
}

Status writeReport(const PaperOptions& options, const std::string& name, const PaperReport& report) {
  if (options.folder.empty()) return {};
  const std::filesystem::path folder{options.folder};
  if (Status status = writeText(folder / (name + ".json"), report.json.dump(2) + "\n"); !status.ok()) return status;
  return writeText(folder / (name + ".txt"), report.text);
}

}  // namespace bleedsim::lab
