#include "service/picture/plot.h"

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <unistd.h>

#include "service/picture/gnuplot.h"
#include "service/picture/plot_text.h"

namespace bleedsim::picture {
namespace {

Status ioError(const std::filesystem::path& path, int error) {
  const char* advice =
      error == ENOENT || error == ENOTDIR ? "; create its folder first" : "; choose a folder with space that you may write to";
  return {StatusCode::io, "cannot write '" + path.string() + "': " + std::generic_category().message(error) + advice};
}

Status renameTo(const std::filesystem::path& part, const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(part, path, error);
  if (!error) return {};
  const int reason = error.value();
  std::filesystem::remove(part, error);
  return ioError(path, reason);
}

std::string partSuffix() { return ".part" + std::to_string(::getpid()); }

Status writeText(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path part = path.string() + partSuffix();
  errno = 0;
  std::ofstream file{part, std::ios::binary | std::ios::trunc};
  if (!file) return ioError(path, errno != 0 ? errno : EIO);
  file << text;
  file.close();
  if (!file) {
    const int reason = errno != 0 ? errno : EIO;
    std::error_code error;
    std::filesystem::remove(part, error);
    return ioError(path, reason);
  }
  return renameTo(part, path);
}

std::string searchPath(const PlotOptions& options) {
  if (options.search_path) return *options.search_path;
  const char* path = std::getenv("PATH");
  return path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
}

template <class Plot>
Result<PlotFiles> write(const std::filesystem::path& folder, const std::string& name, const Plot& plot,
                        const PlotOptions& options) {
  if (const Status status = checkPlotName(name); !status.ok()) return status;
  if (const Status status = checkPlotOptions(options); !status.ok()) return status;
  if (const Status status = checkPlot(plot); !status.ok()) return status;
  PlotFiles files{folder / (name + ".csv"), folder / (name + ".gnuplot"), {}, false, {}};
  const std::filesystem::path png = folder / (name + ".png");
  std::error_code error;
  std::filesystem::remove(png, error);
  if (const Status status = writeText(files.csv, csvOf(plot)); !status.ok()) return status;
  if (const Status status = writeText(files.script, scriptOf(plot, name, name + ".png", options)); !status.ok()) return status;

  const std::optional<std::filesystem::path> gnuplot = findProgram("gnuplot", searchPath(options));
  if (!gnuplot) {
    files.advice = "gnuplot is not installed, so only '" + files.csv.string() + "' and '" + files.script.string() +
                   "' were written; install it (apt-get install gnuplot-nox) for a picture";
    return files;
  }
  if (const Status status = runGnuplot(*gnuplot, folder, name + ".gnuplot", options.patience_s); !status.ok()) {
    std::filesystem::remove(png, error);
    return status;
  }
  if (!std::filesystem::is_regular_file(png, error)) {
    return Status{StatusCode::internal, std::string{"'"} + gnuplot->string() + "' ended well but wrote no '" + png.string() +
                                            "'; check its installation"};
  }
  files.png = png;
  files.drawn = true;
  return files;
}

}  // namespace

Result<PlotFiles> writePlot(const std::filesystem::path& folder, const std::string& name, const LinePlot& plot,
                            const PlotOptions& options) {
  return write(folder, name, plot, options);
}

Result<PlotFiles> writePlot(const std::filesystem::path& folder, const std::string& name, const BarPlot& plot,
                            const PlotOptions& options) {
  return write(folder, name, plot, options);
}

}  // namespace bleedsim::picture
