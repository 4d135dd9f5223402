// The files of a plot as texts. All functions expect plots that have passed checkPlot.
#pragma once

#include <string>
#include <string_view>

#include "service/picture/plot.h"

namespace bleedsim::picture {

/// invalid_argument: what is wrong with the plot and what is allowed.
Status checkPlot(const LinePlot& plot);
Status checkPlot(const BarPlot& plot);
Status checkPlotName(const std::string& name);
Status checkPlotOptions(const PlotOptions& options);

/// RFC 4180 with '\n': a header, then x, y and name of the series; one row a point, series after series.
std::string csvOf(const LinePlot& plot);
/// A header, then one row a category: its number from 0, one column a series, its name.
std::string csvOf(const BarPlot& plot);

/// Reads `name`.csv and writes `output`, both beside the script.
std::string scriptOf(const LinePlot& plot, const std::string& name, const std::string& output, const PlotOptions& options);
std::string scriptOf(const BarPlot& plot, const std::string& name, const std::string& output, const PlotOptions& options);

/// The shortest digits that read back as the same number; "nan".
std::string plotNumber(double value);
/// The text as a gnuplot string between double quotes: quotes, backslashes and backquotes are escaped, nothing else has a meaning
/// there. Between single quotes gnuplot 5.4 reads doubled ones wrongly at the start and side by side.
std::string gnuplotString(std::string_view text);
/// The same for the name of a tic, in which '%' would start a format.
std::string gnuplotTic(std::string_view text);
/// A CSV field: quoted when needed, quotes doubled.
std::string csvField(std::string_view text);

}  // namespace bleedsim::picture
