#include <array>
#include <charconv>
#include <cmath>

#include "service/picture/plot_text.h"

namespace bleedsim::picture {

std::string plotNumber(double value) {
  if (std::isnan(value)) return "nan";
  std::array<char, 40> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end.ptr};
}

std::string csvField(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string{text};
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  field += '"';
  return field;
}

std::string csvOf(const LinePlot& plot) {
  std::string csv = csvField(plot.x.label.empty() ? "x" : plot.x.label);
  csv += ',';
  csv += csvField(plot.y.label.empty() ? "y" : plot.y.label);
  csv += ",series\n";
  for (const Series& series : plot.series) {
    const std::string name = csvField(series.name);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      csv += plotNumber(series.x[i]);
      csv += ',';
      csv += plotNumber(series.y[i]);
      csv += ',';
      csv += name;
      csv += '\n';
    }
  }
  return csv;
}

std::string csvOf(const BarPlot& plot) {
  std::string csv = "number";
  for (const BarSeries& series : plot.series) {
    csv += ',';
    csv += csvField(series.name);
  }
  csv += ',';
  csv += csvField(plot.category_label.empty() ? "category" : plot.category_label);
  csv += '\n';
  for (std::size_t i = 0; i < plot.categories.size(); ++i) {
    csv += std::to_string(i);
    for (const BarSeries& series : plot.series) {
      csv += ',';
      csv += plotNumber(series.values[i]);
    }
    csv += ',';
    csv += csvField(plot.categories[i]);
    csv += '\n';
  }
  return csv;
}

}  // namespace bleedsim::picture
