// Plots of numbers by gnuplot, an optional program: the data and the script are written always, the picture when gnuplot is
// there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/status/status.h"

namespace bleedsim::picture {

// Texts are UTF-8 without control characters and at most kMostPlotText bytes; they are shown as they are, nothing in them is
// markup.
constexpr std::size_t kMostPlotText = 200;

struct Axis {
  std::string label;            ///< with unit
  bool log = false;             ///< all that is shown must then be above 0
  std::optional<double> lower;  ///< nothing: chosen by the data
  std::optional<double> upper;
};

enum class SeriesStyle { line, points, line_with_points };

struct Series {
  std::string name;  ///< in the legend; empty: not there
  SeriesStyle style = SeriesStyle::line;
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x; NaN in either breaks the line
};

struct ReferenceLine {
  enum class Direction { horizontal, vertical };
  Direction direction = Direction::horizontal;
  double at = 0.0;    ///< y of a horizontal line, x of a vertical one
  std::string label;  ///< beside the line
};

struct LinePlot {
  std::string title;
  Axis x;
  Axis y;
  std::vector<Series> series;
  std::vector<ReferenceLine> lines;
};

struct BarSeries {
  std::string name;
  std::vector<double> values;  ///< one for each category; NaN: no bar
};

struct BarPlot {
  std::string title;
  std::string category_label;
  Axis y;
  std::vector<std::string> categories;
  std::vector<BarSeries> series;
  std::vector<ReferenceLine> lines;  ///< horizontal ones only
};

struct PlotOptions {
  int width = 1200;  ///< pixels, 200 to 8000
  int height = 800;
  std::optional<std::string> search_path{};  ///< folders with ':' between; nothing: PATH of this process
  double patience_s = 60.0;                  ///< for gnuplot
};

struct PlotFiles {
  std::filesystem::path csv;
  std::filesystem::path script;
  std::filesystem::path png;  ///< only when drawn
  bool drawn = false;
  std::string advice;  ///< when not drawn: for the user, what to install
};

/// Writes NAME.csv, NAME.gnuplot and, if gnuplot is found, NAME.png into `folder`, which must exist; existing ones are replaced,
/// and an old NAME.png does not stay beside new data. NAME: letters, digits, '-' and '_'. The script can be run again in its
/// folder. A missing gnuplot is no error. invalid_argument: names the series, axis or text and what is allowed; io: a file cannot
/// be written; internal: gnuplot failed, with what it said; timed_out: it took longer than the patience.
Result<PlotFiles> writePlot(const std::filesystem::path& folder, const std::string& name, const LinePlot& plot,
                            const PlotOptions& options = {});
Result<PlotFiles> writePlot(const std::filesystem::path& folder, const std::string& name, const BarPlot& plot,
                            const PlotOptions& options = {});

}  // namespace bleedsim::picture
