#include <algorithm>
#include <cmath>
#include <cstdint>

#include "service/picture/plot_text.h"

namespace bleedsim::picture {
namespace {

constexpr int kLeastPixels = 200;
constexpr int kMostPixels = 8000;

Status invalid(const std::string& message) { return {StatusCode::invalid_argument, message}; }

std::string quoted(const std::string& text) { return std::string{"'"} + text + "'"; }

/// The bytes that follow a first byte of UTF-8, or -1. Overlong forms of three and four bytes are left to the reader.
int bytesAfter(std::uint8_t first) {
  if (first < 0x80U) return 0;
  if (first >= 0xc2U && first <= 0xdfU) return 1;
  if (first >= 0xe0U && first <= 0xefU) return 2;
  if (first >= 0xf0U && first <= 0xf4U) return 3;
  return -1;
}

bool isShowable(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<std::uint8_t>(text[i]);
    const int more = bytesAfter(first);
    if (first < 0x20U || first == 0x7fU || more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return false;
    for (int k = 1; k <= more; ++k) {
      if ((static_cast<std::uint8_t>(text[i + static_cast<std::size_t>(k)]) & 0xc0U) != 0x80U) return false;
    }
    i += static_cast<std::size_t>(more) + 1;
  }
  return true;
}

Status checkText(const std::string& text, const char* what) {
  if (text.size() > kMostPlotText) {
    return invalid(std::string{"the plot's "} + what + " has " + std::to_string(text.size()) + " bytes: at most " +
                   std::to_string(kMostPlotText) + " are possible");
  }
  if (!isShowable(text)) {
    return invalid(std::string{"the plot's "} + what + " holds a control character or is not UTF-8: use plain text of one line");
  }
  return {};
}

Status checkAxis(const Axis& axis, const char* what) {
  if (const Status status = checkText(axis.label, what); !status.ok()) return status;
  for (const std::optional<double>& end : {axis.lower, axis.upper}) {
    if (!end) continue;
    if (!std::isfinite(*end)) return invalid("the ends of axis " + quoted(axis.label) + " must be finite");
    if (axis.log && !(*end > 0.0)) return invalid("the ends of the logarithmic axis " + quoted(axis.label) + " must be above 0");
  }
  if (axis.lower && axis.upper && !(*axis.lower < *axis.upper)) {
    return invalid("the lower end of axis " + quoted(axis.label) + " must be below its upper one");
  }
  return {};
}

/// Infinite numbers and those a logarithm does not have; NaN is a gap.
Status checkNumbers(const std::vector<double>& numbers, const Axis& axis, const std::string& series) {
  const auto bad = std::find_if(numbers.begin(), numbers.end(),
                                [&axis](double number) { return std::isinf(number) || (axis.log && number <= 0.0); });
  if (bad == numbers.end()) return {};
  return invalid("value " + std::to_string(bad - numbers.begin()) + " of series " + quoted(series) + " is " +
                 std::to_string(*bad) +
                 (std::isinf(*bad) ? ", not finite: leave it out or set NaN"
                                   : ", which a logarithmic axis cannot show: leave it out, set NaN or use a linear axis"));
}

Status checkLine(const ReferenceLine& line, const Axis& axis) {
  if (const Status status = checkText(line.label, "label of a line"); !status.ok()) return status;
  if (!std::isfinite(line.at)) return invalid("the line " + quoted(line.label) + " must be at a finite value");
  if (axis.log && !(line.at > 0.0)) {
    return invalid("the line " + quoted(line.label) + " on the logarithmic axis must be at a value above 0");
  }
  return {};
}

bool hasNumber(const std::vector<double>& numbers) {
  return std::any_of(numbers.begin(), numbers.end(), [](double number) { return !std::isnan(number); });
}

}  // namespace

Status checkPlotName(const std::string& name) {
  const bool good = !name.empty() && name.size() <= 100 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  });
  if (good && name.front() != '-') return {};
  return invalid("a plot cannot have the name " + quoted(name) +
                 ": use 1 to 100 letters, digits, '_' and '-', the last not in front");
}

Status checkPlotOptions(const PlotOptions& options) {
  for (const int side : {options.width, options.height}) {
    if (side < kLeastPixels || side > kMostPixels) {
      return invalid("a plot's side of " + std::to_string(side) + " pixels is not possible: choose " +
                     std::to_string(kLeastPixels) + " to " + std::to_string(kMostPixels));
    }
  }
  if (!(options.patience_s > 0.0 && options.patience_s <= 3600.0))
    return invalid("the patience with gnuplot must be above 0 and at most 3600 s");
  return {};
}

Status checkPlot(const LinePlot& plot) {
  if (const Status status = checkText(plot.title, "title"); !status.ok()) return status;
  if (const Status status = checkAxis(plot.x, "x label"); !status.ok()) return status;
  if (const Status status = checkAxis(plot.y, "y label"); !status.ok()) return status;
  if (plot.series.empty()) return invalid("the plot has no series: give at least one");
  for (const Series& series : plot.series) {
    if (const Status status = checkText(series.name, "name of a series"); !status.ok()) return status;
    if (series.x.size() != series.y.size()) {
      return invalid("series " + quoted(series.name) + " has " + std::to_string(series.x.size()) + " x and " +
                     std::to_string(series.y.size()) + " y: give as many of both");
    }
    if (const Status status = checkNumbers(series.x, plot.x, series.name); !status.ok()) return status;
    if (const Status status = checkNumbers(series.y, plot.y, series.name); !status.ok()) return status;
    const bool shown = [&series] {
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!std::isnan(series.x[i]) && !std::isnan(series.y[i])) return true;
      }
      return false;
    }();
    if (!shown) return invalid("series " + quoted(series.name) + " has no point that can be shown: leave it out");
  }
  for (const ReferenceLine& line : plot.lines) {
    const bool vertical = line.direction == ReferenceLine::Direction::vertical;
    if (const Status status = checkLine(line, vertical ? plot.x : plot.y); !status.ok()) return status;
  }
  return {};
}

Status checkPlot(const BarPlot& plot) {
  if (const Status status = checkText(plot.title, "title"); !status.ok()) return status;
  if (const Status status = checkText(plot.category_label, "category label"); !status.ok()) return status;
  if (const Status status = checkAxis(plot.y, "y label"); !status.ok()) return status;
  if (plot.categories.empty() || plot.series.empty()) return invalid("a bar chart needs at least one category and one series");
  for (const std::string& category : plot.categories) {
    if (const Status status = checkText(category, "category"); !status.ok()) return status;
  }
  for (const BarSeries& series : plot.series) {
    if (const Status status = checkText(series.name, "name of a series"); !status.ok()) return status;
    if (series.values.size() != plot.categories.size()) {
      return invalid("series " + quoted(series.name) + " has " + std::to_string(series.values.size()) + " values for " +
                     std::to_string(plot.categories.size()) + " categories: give one each, NaN where there is none");
    }
    if (const Status status = checkNumbers(series.values, plot.y, series.name); !status.ok()) return status;
    if (!hasNumber(series.values)) return invalid("series " + quoted(series.name) + " has no value: leave it out");
  }
  for (const ReferenceLine& line : plot.lines) {
    if (line.direction == ReferenceLine::Direction::vertical) {
      return invalid("a bar chart has no vertical lines: remove " + quoted(line.label));
    }
    if (const Status status = checkLine(line, plot.y); !status.ok()) return status;
  }
  return {};
}

}  // namespace bleedsim::picture
