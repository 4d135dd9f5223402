#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "service/picture/plot_text.h"

namespace bleedsim::picture {
namespace {

// M. Okabe, K. Ito, "Color Universal Design", 2008: eight colours that colour-blind people tell apart; without its yellow, which
// is too light for lines on white.
constexpr std::array<const char*, 7> kColors{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"};
// Marks differ as well: filled circle, square, triangles, diamond, pentagon and a star.
constexpr std::array<int, 7> kMarks{7, 5, 9, 13, 11, 15, 3};
constexpr double kTextPixels = 20.0;  // at 1200 x 800
constexpr double kHuge = std::numeric_limits<double>::max();

/// The parts one after the other. A chain of + on literals and temporaries trips GCC 12's -Wrestrict.
std::string joined(const auto&... parts) {
  std::string all;
  ((all += parts), ...);
  return all;
}

std::string number(double value) { return plotNumber(value); }

struct Extent {
  double low = kHuge;
  double high = -kHuge;

  void add(double value) {
    if (std::isnan(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string head(const std::string& title, const std::string& output, const PlotOptions& options) {
  const double scale = std::sqrt(options.width / 1200.0 * (options.height / 800.0));
  const auto text = std::max(8L, std::lround(kTextPixels * scale));
  std::string script = "# Run in this folder: gnuplot FILE\nset encoding utf8\n";
  // 'noenhanced' for the whole terminal: '_', '^', '{' and '@' in texts are just themselves.
  script += joined("set terminal pngcairo noenhanced size ", std::to_string(options.width), ",", std::to_string(options.height));
  script += joined(" background rgb '#FFFFFF' font 'sans,", std::to_string(text), "' fontscale 0.8 linewidth ",
                   number(std::round(10.0 * scale) / 10.0), "\n");
  script += joined("set output ", gnuplotString(output), "\n");
  script +=
      "set datafile separator comma\n"
      "set border 3 linecolor rgb '#404040' linewidth 1.2\n"
      "set tics nomirror\n"
      "set grid xtics ytics linetype 1 linecolor rgb '#D4D4D4' linewidth 0.7 dashtype solid\n"
      "set key tmargin center horizontal Left reverse samplen 2.5 width 1\n"
      "set rmargin 4\n";
  if (!title.empty()) {
    script += joined("set title ", gnuplotString(title), " font 'sans,", std::to_string(text * 6 / 5), "'\n");
  }
  return script;
}

/// `data` is what the series show, `lines` where the reference lines are. gnuplot chooses ranges by the data alone and would
/// leave lines outside, so the end that a line is beyond is set.
std::string axis(const char* name, const Axis& description, const Extent& data, const Extent& lines) {
  std::string script;
  if (!description.label.empty()) script += joined("set ", name, "label ", gnuplotString(description.label), "\n");
  if (description.log) script += joined("set logscale ", name, " 10\nset format ", name, " '%g'\n");
  std::optional<double> lower = description.lower;
  std::optional<double> upper = description.upper;

  const double factor = description.log ? 1.25 : 1.0;
  // Logarithmic ranges are always set: gnuplot's own end at whole decades, with up to a decade of nothing.
  const double low = std::min(data.low, lines.low);
  const double high = std::max(data.high, lines.high);
  const double room = description.log ? 0.0 : 0.06 * (high - low);
  if (!lower && (description.log || low < data.low)) lower = low / factor - room;
  if (!upper && (description.log || high > data.high)) upper = high * factor + room;
  // An end that was asked for may lie beyond all data.
  if (lower && upper && !(*lower < *upper)) (description.lower ? upper : lower).reset();
  if (lower || upper) {
    script += joined("set ", name, "range [", lower ? number(*lower) : "*", ":", upper ? number(*upper) : "*", "]\n");
  }
  return script;
}

/// From edge to edge, whatever the ranges turn out to be.
std::string referenceLines(const std::vector<ReferenceLine>& lines) {
  std::string script;
  for (const ReferenceLine& line : lines) {
    const bool vertical = line.direction == ReferenceLine::Direction::vertical;
    const std::string at = number(line.at);
    const std::string from = vertical ? joined("first ", at, ", graph 0") : joined("graph 0, first ", at);
    const std::string to = vertical ? joined("first ", at, ", graph 1") : joined("graph 1, first ", at);
    script += joined("set arrow from ", from, " to ", to, " nohead front linecolor rgb '#606060' linewidth 1.4 dashtype 2\n");
    if (line.label.empty()) continue;
    const std::string place = vertical ? joined("first ", at, ", graph 0.98 right rotate by 90 offset character -1.0,0")
                                       : joined("graph 0.99, first ", at, " right offset character 0,0.5");
    script += joined("set label ", gnuplotString(line.label), " at ", place, " front textcolor rgb '#404040'\n");
  }
  return script;
}

Extent extentOf(const std::vector<ReferenceLine>& lines, ReferenceLine::Direction direction) {
  Extent extent;
  for (const ReferenceLine& line : lines) {
    if (line.direction == direction) extent.add(line.at);
  }
  return extent;
}

std::string inLegend(const std::string& name) {
  return name.empty() ? std::string{" notitle"} : joined(" title ", gnuplotString(name));
}

const char* between(std::size_t index) { return index == 0 ? "plot " : ", \\\n     "; }

std::string look(const Series& series, std::size_t index) {
  const std::string color = joined(" linecolor rgb '", kColors[index % kColors.size()], "'");
  const std::string mark = joined(" pointtype ", std::to_string(kMarks[index % kMarks.size()]), " pointsize 1.3");
  // The colours repeat after seven: then the dashes differ.
  const std::string line = joined(" linewidth 2.4 dashtype ", std::to_string(1 + index / kColors.size() % 5));
  switch (series.style) {
    case SeriesStyle::line:
      return joined(" with lines", color, line);
    case SeriesStyle::points:
      return joined(" with points", color, mark);
    case SeriesStyle::line_with_points:
      break;
  }
  return joined(" with linespoints", color, line, mark);
}

}  // namespace

std::string gnuplotString(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '`') {
      quoted += "\\140";  // it would run what follows
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

std::string gnuplotTic(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (c == '%') plain += c;
    plain += c;
  }
  return gnuplotString(plain);
}

std::string scriptOf(const LinePlot& plot, const std::string& name, const std::string& output, const PlotOptions& options) {
  Extent x;
  Extent y;
  for (const Series& series : plot.series) {
    for (const double one : series.x) x.add(one);
    for (const double one : series.y) y.add(one);
  }
  std::string script = head(plot.title, output, options);
  script += axis("x", plot.x, x, extentOf(plot.lines, ReferenceLine::Direction::vertical));
  script += axis("y", plot.y, y, extentOf(plot.lines, ReferenceLine::Direction::horizontal));
  script += referenceLines(plot.lines);
  // Names stand in the last column: gnuplot reads only the two before it, whatever a name looks like. Row 0 is the header.
  std::size_t row = 1;
  const std::string csv = gnuplotString(name + ".csv");
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    const std::size_t last = row + series.x.size() - 1;
    script += joined(between(i), csv, " every ::", std::to_string(row), "::", std::to_string(last), " using 1:2", look(series, i),
                     inLegend(series.name));
    row = last + 1;
  }
  script += "\nset output\n";
  return script;
}

std::string scriptOf(const BarPlot& plot, const std::string& name, const std::string& output, const PlotOptions& options) {
  Extent data;
  for (const BarSeries& series : plot.series) {
    for (const double one : series.values) data.add(one);
  }
  Axis y = plot.y;
  // A bar's length is its value: bars start at 0 unless the axis says otherwise.
  if (!y.log && !y.lower && data.low >= 0.0 && (!y.upper || *y.upper > 0.0)) y.lower = 0.0;
  std::string script = head(plot.title, output, options);
  if (!plot.category_label.empty()) script += joined("set xlabel ", gnuplotString(plot.category_label), "\n");
  script += axis("y", y, data, extentOf(plot.lines, ReferenceLine::Direction::horizontal));
  script += referenceLines(plot.lines);

  std::size_t longest = 0;
  std::string tics;
  for (std::size_t i = 0; i < plot.categories.size(); ++i) {
    longest = std::max(longest, plot.categories[i].size());
    tics += joined(i == 0 ? "" : ", ", gnuplotTic(plot.categories[i]), " ", std::to_string(i));
  }
  const bool slanted = longest * plot.categories.size() > 80;
  script +=
      "set grid noxtics\n"
      "set style data histograms\n"
      "set style histogram clustered gap 1\n"
      "set style fill solid 0.9 noborder\n"
      "set boxwidth 0.92 relative\n";
  script += joined("set xrange [-0.6:", number(static_cast<double>(plot.categories.size()) - 0.4), "]\n");
  if (slanted) script += "set rmargin 12\n";  // the last label begins under its bar
  script += joined("set xtics ", slanted ? "rotate by -25 left " : "", "(", tics, ")\n");
  const std::string csv = gnuplotString(name + ".csv");
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    script += joined(between(i), csv, " every ::1 using ", std::to_string(i + 2), " linecolor rgb '", kColors[i % kColors.size()],
                     "'", inLegend(plot.series[i].name));
  }
  script += "\nset output\n";
  return script;
}

}  // namespace bleedsim::picture
