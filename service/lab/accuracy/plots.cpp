#include "service/lab/accuracy/plots.h"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

#include "service/lab/cost_plot.h"
#include "service/lab/lab_files.h"

namespace bleedsim::lab {
namespace {

/// CPU time against error, all settings of a case.
picture::LinePlot workPlot(const AccuracyResults& results, const ValidationCase& which) {
  const std::string_view figure = which.error_figures.front();
  picture::LinePlot plot;
  plot.title = fmt::format("{}: error against time", which.name);
  plot.x = {"CPU seconds for each simulated second", true, {}, {}};
  plot.y = {fmt::format("error of {}", figure), true, {}, {}};
  std::vector<double> time;
  std::vector<double> errors;
  for (const Measurement& one : results.measurements) {
    const Figure* found = one.setting.which == &which ? one.find(figure) : nullptr;
    if (found == nullptr || !(found->error > 0.0)) continue;
    time.push_back(one.cpu.median);
    errors.push_back(found->error);
    const std::string& knob = one.setting.knob;
    auto series = std::find_if(plot.series.begin(), plot.series.end(), [&](const picture::Series& s) { return s.name == knob; });
    if (series == plot.series.end()) {
      plot.series.push_back({knob, picture::SeriesStyle::points, {}, {}});
      series = plot.series.end() - 1;
    }
    series->x.push_back(one.cpu.median);
    series->y.push_back(found->error);
  }
  if (plot.series.empty()) return plot;
  picture::Series front{"Pareto front", picture::SeriesStyle::line, {}, {}};
  for (const std::size_t k : paretoFront(time, errors)) {
    front.x.push_back(time[k]);
    front.y.push_back(errors[k]);
  }
  plot.series.push_back(front);
  plot.lines.push_back({picture::ReferenceLine::Direction::vertical, 1.0, "real time on one core"});
  return plot;
}

/// Error against one knob, a line for each case: its first figure. `also`: part of the names of others that are shown, too.
picture::LinePlot knobPlot(const AccuracyResults& results, const std::string& knob, const std::string& label,
                           double (*value)(const Knobs&), const std::optional<std::string>& also = {}) {
  picture::LinePlot plot;
  plot.title = "Error against " + label;
  plot.x = {label, true, {}, {}};
  plot.y = {"error", true, {}, {}};
  for (const ValidationCase* which : casesIn(results)) {
    for (const std::string_view figure : errorFiguresOf(*which)) {
      const bool shown = figure == which->error_figures.front() || (also && figure.find(*also) != std::string_view::npos);
      if (!shown) continue;
      std::vector<std::pair<double, double>> points;
      for (const Measurement& one : results.measurements) {
        const Figure* found = one.setting.which == which ? one.find(figure) : nullptr;
        if (found == nullptr || !(found->error > 0.0)) continue;
        if (one.setting.knob == knob || one.setting.knob == "base") points.emplace_back(value(one.setting.knobs), found->error);
      }
      if (points.size() < 2) continue;
      std::sort(points.begin(), points.end());
      picture::Series series{fmt::format("{} {}", which->name, figure), picture::SeriesStyle::line_with_points, {}, {}};
      for (const auto& [x, y] : points) {
        series.x.push_back(x);
        series.y.push_back(y);
      }
      plot.series.push_back(series);
    }
  }
  return plot;
}

template <class Plot>
Status add(const std::string& folder, const std::string& name, const Plot& plot, std::vector<WrittenPlot>& written) {
  if (plot.series.empty()) return {};
  WrittenPlot one{name, {}};
  if (Status status = writeSmallPlot(folder, name, plot, one.picture); !status.ok()) return status;
  written.push_back(std::move(one));
  return {};
}

}  // namespace

Result<std::vector<WrittenPlot>> writePlots(const std::string& folder, const AccuracyResults& results) {
  std::vector<WrittenPlot> written;
  for (const ValidationCase* which : casesIn(results)) {
    if (Status s = add(folder, fmt::format("work_{}", which->name), workPlot(results, *which), written); !s.ok()) return s;
  }
  const auto across = [](const Knobs& knobs) { return double(knobs.across); };
  const auto cfl = [](const Knobs& knobs) { return knobs.cfl; };
  const auto mach = [](const Knobs& knobs) { return knobs.mach_factor; };
  if (Status s = add(folder, "spacing", knobPlot(results, "spacing", "particles across", across), written); !s.ok()) return s;
  if (Status s = add(folder, "time_step", knobPlot(results, "cfl", "CFL number", cfl), written); !s.ok()) return s;
  if (Status s = add(folder, "compressibility", knobPlot(results, "mach", "Mach factor", mach, "compression"), written); !s.ok())
    return s;
  if (results.effects) {
    const auto bars = costPlot(*results.effects, "Cost of each effect, h = 2.5 dx", "on alone");
    if (Status s = add(folder, "effects_cost", bars, written); !s.ok()) return s;
  }
  return written;
}

}  // namespace bleedsim::lab
