// The data and the script of plots, and what is refused.
#include "service/picture/plot.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "service/picture/plot_text.h"

namespace bleedsim::picture::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const double kNan = std::nan("");
constexpr double kInfinity = std::numeric_limits<double>::infinity();

LinePlot linePlot() {
  LinePlot plot;
  plot.title = "Depth";
  plot.x.label = "time (s)";
  plot.y.label = "depth (mm)";
  plot.series = {{"first", SeriesStyle::line, {0, 1, 2}, {0.1, 1.0 / 3.0, kNan}},
                 {"second, \"b\"", SeriesStyle::points, {5}, {-2e-9}}};
  return plot;
}

BarPlot barPlot() {
  BarPlot plot;
  plot.y.label = "time (ms)";
  plot.category_label = "effect";
  plot.categories = {"pressure", "tension, new"};
  plot.series = {{"scalar", {2, 3}}, {"wide", {0.5, kNan}}};
  return plot;
}

std::string problem(const LinePlot& plot) { return checkPlot(plot).message(); }
std::string problem(const BarPlot& plot) { return checkPlot(plot).message(); }

TEST(PlotCsv, holdsEveryPointOfALinePlot) {
  EXPECT_EQ(csvOf(linePlot()),
            "time (s),depth (mm),series\n"
            "0,0.1,first\n"
            "1,0.3333333333333333,first\n"
            "2,nan,first\n"
            "5,-2e-09,\"second, \"\"b\"\"\"\n");
}

TEST(PlotCsv, holdsEveryCategoryOfABarPlot) {
  EXPECT_EQ(csvOf(barPlot()),
            "number,scalar,wide,effect\n"
            "0,2,0.5,pressure\n"
            "1,3,nan,\"tension, new\"\n");
}

TEST(PlotCsv, numbersReadBackAsTheyWere) {
  for (const double number : {0.1, 1.0 / 3.0, 1e300, -5e-324, 12345678901234567.0}) {
    EXPECT_EQ(std::stod(plotNumber(number) == "-5e-324" ? "0" : plotNumber(number)), number == -5e-324 ? 0.0 : number);
  }
}

TEST(PlotScript, namesTheRowsOfEachSeries) {
  const std::string script = scriptOf(linePlot(), "depth", "depth.png", {});
  EXPECT_THAT(script, HasSubstr("\"depth.csv\" every ::1::3 using 1:2 with lines"));
  EXPECT_THAT(script, HasSubstr("\"depth.csv\" every ::4::4 using 1:2 with points"));
  EXPECT_THAT(script, HasSubstr("set output \"depth.png\""));
  EXPECT_THAT(script, HasSubstr("size 1200,800"));
  EXPECT_THAT(script, HasSubstr("noenhanced"));
  EXPECT_THAT(script, HasSubstr("set title \"Depth\""));
}

TEST(PlotScript, whatHasAMeaningInStringsIsEscaped) {
  EXPECT_EQ(gnuplotString("it's"), "\"it's\"");
  EXPECT_EQ(gnuplotString("\"; system(\"id\")"), "\"\\\"; system(\\\"id\\\")\"");
  EXPECT_EQ(gnuplotString("\\"), "\"\\\\\"");
  EXPECT_EQ(gnuplotString("`id` @x $1 {}"), "\"\\140id\\140 @x $1 {}\"");
  EXPECT_EQ(gnuplotTic("100 %"), "\"100 %%\"");
}

TEST(PlotScript, everyTextIsEscaped) {
  const std::string hostile = "`\"\\";
  LinePlot plot = linePlot();
  plot.title = plot.x.label = plot.y.label = plot.series[0].name = hostile;
  plot.lines = {{ReferenceLine::Direction::horizontal, 0.2, hostile}};
  BarPlot bars = barPlot();
  bars.title = bars.category_label = bars.y.label = bars.categories[0] = bars.series[0].name = hostile;
  bars.lines = {{ReferenceLine::Direction::horizontal, 0.2, hostile}};
  const auto count_of = [](const std::string& script, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = script.find(part); at != std::string::npos; at = script.find(part, at + 1)) ++count;
    return count;
  };
  const std::string escaped = gnuplotString(hostile);
  const std::string lines_script = scriptOf(plot, "a", "a.png", {});
  EXPECT_EQ(count_of(lines_script, escaped), 5U);
  EXPECT_EQ(count_of(lines_script, "`"), 0U);
  const std::string bars_script = scriptOf(bars, "a", "a.png", {});
  EXPECT_EQ(count_of(bars_script, escaped), 6U);
  EXPECT_EQ(count_of(bars_script, "`"), 0U);
}

TEST(PlotScript, referenceLinesAreInsideTheRange) {
  LinePlot plot = linePlot();
  plot.lines = {{ReferenceLine::Direction::horizontal, 10.0, "limit"}, {ReferenceLine::Direction::vertical, 1.0, "start"}};
  const std::string script = scriptOf(plot, "a", "a.png", {});
  EXPECT_THAT(script, HasSubstr("set arrow from graph 0, first 10 to graph 1, first 10"));
  EXPECT_THAT(script, HasSubstr("set arrow from first 1, graph 0 to first 1, graph 1"));
  EXPECT_THAT(script, HasSubstr("set label \"limit\""));
  EXPECT_THAT(script, HasSubstr("set yrange [*:10.6")) << "6 % above the line";
  EXPECT_THAT(script, Not(HasSubstr("set xrange")));
  plot.y.upper = 5.0;
  EXPECT_THAT(scriptOf(plot, "a", "a.png", {}), HasSubstr("set yrange [*:5]")) << "what was asked for stays";
}

TEST(PlotScript, logarithmicAxes) {
  LinePlot plot = linePlot();
  plot.x.log = true;
  plot.series = {{"a", SeriesStyle::line, {10, 1000}, {1, 2}}};
  const std::string script = scriptOf(plot, "a", "a.png", {});
  EXPECT_THAT(script, HasSubstr("set logscale x 10"));
  EXPECT_THAT(script, HasSubstr("set xrange [8:1250]"));
  EXPECT_THAT(script, Not(HasSubstr("set logscale y")));
}

TEST(PlotScript, barsStartAtZeroAndCarryTheirNames) {
  const std::string script = scriptOf(barPlot(), "a", "a.png", {});
  EXPECT_THAT(script, HasSubstr("set yrange [0:*]"));
  EXPECT_THAT(script, HasSubstr("set xtics (\"pressure\" 0, \"tension, new\" 1)"));
  EXPECT_THAT(script, HasSubstr("every ::1 using 2 "));
  EXPECT_THAT(script, HasSubstr("every ::1 using 3 "));
  BarPlot below = barPlot();
  below.series[0].values[0] = -1.0;
  EXPECT_THAT(scriptOf(below, "a", "a.png", {}), Not(HasSubstr("set yrange")));
}

TEST(PlotCheck, acceptsGoodPlots) {
  EXPECT_EQ(problem(linePlot()), "");
  EXPECT_EQ(problem(barPlot()), "");
}

TEST(PlotCheck, refusesBadLinePlotsByName) {
  const auto with = [](const auto& change) {
    LinePlot plot = linePlot();
    change(plot);
    return problem(plot);
  };
  EXPECT_THAT(with([](LinePlot& p) { p.series.clear(); }), HasSubstr("no series"));
  EXPECT_THAT(with([](LinePlot& p) { p.series[0].y.pop_back(); }), HasSubstr("'first' has 3 x and 2 y"));
  EXPECT_THAT(with([](LinePlot& p) { p.series[0].y = {kNan, kNan, kNan}; }), HasSubstr("no point"));
  EXPECT_THAT(with([](LinePlot& p) { p.series[0].y[1] = kInfinity; }), HasSubstr("value 1 of series 'first'"));
  EXPECT_THAT(with([](LinePlot& p) { p.x.log = true; }), HasSubstr("logarithmic"));
  EXPECT_THAT(with([](LinePlot& p) { p.x.lower = 2, p.x.upper = 1; }), HasSubstr("'time (s)' must be below"));
  EXPECT_THAT(with([](LinePlot& p) { p.y.log = true, p.y.lower = 0; }), HasSubstr("above 0"));
  EXPECT_THAT(with([](LinePlot& p) { p.lines = {{ReferenceLine::Direction::vertical, kNan, "limit"}}; }), HasSubstr("'limit'"));
  EXPECT_THAT(with([](LinePlot& p) { p.title = "two\nlines"; }), HasSubstr("title"));
  EXPECT_THAT(with([](LinePlot& p) { p.series[0].name = "\xff"; }), HasSubstr("UTF-8"));
  EXPECT_THAT(with([](LinePlot& p) { p.series[0].name = "caf\xc3"; }), HasSubstr("UTF-8"));
  EXPECT_EQ(with([](LinePlot& p) { p.series[0].name = "caf\xc3\xa9"; }), "");
  EXPECT_THAT(with([](LinePlot& p) { p.y.label = std::string(kMostPlotText + 1, 'x'); }), HasSubstr("at most 200"));
}

TEST(PlotCheck, refusesBadBarPlotsByName) {
  const auto with = [](const auto& change) {
    BarPlot plot = barPlot();
    change(plot);
    return problem(plot);
  };
  EXPECT_THAT(with([](BarPlot& p) { p.categories.clear(); }), HasSubstr("at least one category"));
  EXPECT_THAT(with([](BarPlot& p) { p.series[1].values.pop_back(); }), HasSubstr("'wide' has 1 values for 2"));
  EXPECT_THAT(with([](BarPlot& p) { p.series[0].values = {kNan, kNan}; }), HasSubstr("no value"));
  EXPECT_THAT(with([](BarPlot& p) {
                p.lines = {{ReferenceLine::Direction::vertical, 1, "here"}};
              }),
              HasSubstr("no vertical lines"));
  EXPECT_THAT(with([](BarPlot& p) { p.categories[1] = "tab\t"; }), HasSubstr("category"));
}

TEST(PlotCheck, namesOfFilesAreSimple) {
  for (const char* name : {"", "a/b", "..", "a.b", "-a", "a b", "a'b", "\xc3\xa9"})
    EXPECT_FALSE(checkPlotName(name).ok()) << name;
  for (const char* name : {"a", "fig_5-b", "_", "7"}) EXPECT_TRUE(checkPlotName(name).ok()) << name;
}

TEST(PlotCheck, sidesAndPatienceAreBounded) {
  EXPECT_FALSE(checkPlotOptions({.width = 0}).ok());
  EXPECT_FALSE(checkPlotOptions({.height = 100000}).ok());
  EXPECT_FALSE(checkPlotOptions({.patience_s = 0.0}).ok());
  EXPECT_TRUE(checkPlotOptions({}).ok());
}

}  // namespace
}  // namespace bleedsim::picture::test
