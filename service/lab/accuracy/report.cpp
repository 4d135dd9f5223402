#include "service/lab/accuracy/report.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "service/lab/cost_plot.h"
#include "service/lab/lab_files.h"

namespace bleedsim::lab {
namespace {

std::string percent(double error) {
  if (error != 0.0 && error < 5e-5) return fmt::format("{:.1e}", error);
  return fmt::format("{:.2f} %", 100.0 * error);
}

std::string percent(const std::optional<double>& error) { return error ? percent(*error) : "-"; }

std::string spreadText(const Spread& spread) {
  return fmt::format("{:.3g} ({:.3g}-{:.3g})", spread.median, spread.low, spread.high);
}

std::string settingText(const Knobs& knobs) {
  std::string text =
      fmt::format("{} across, h = {} dx, Mach {}, CFL {}", knobs.across, knobs.support_ratio, knobs.mach_factor, knobs.cfl);
  if (knobs.precision == sph::Precision::float64) text += ", double";
  if (knobs.threads > 1) text += fmt::format(", {} threads", knobs.threads);
  return text;
}

/// The cases that have measurements, in their order.
std::vector<const ValidationCase*> casesIn(const AccuracyResults& results) {
  std::vector<const ValidationCase*> cases;
  for (const Measurement& one : results.measurements) {
    if (std::find(cases.begin(), cases.end(), one.setting.which) == cases.end()) cases.push_back(one.setting.which);
  }
  std::sort(cases.begin(), cases.end());  // all are of one catalog
  return cases;
}

/// CPU time against error, all settings of a case.
picture::LinePlot workPlot(const AccuracyResults& results, const ValidationCase& which) {
  picture::LinePlot plot;
  plot.title = fmt::format("{}: error against time", which.name);
  plot.x = {"CPU seconds for each simulated second", true, {}, {}};
  plot.y = {fmt::format("error of {}", which.error_figure), true, {}, {}};
  std::vector<double> time;
  std::vector<double> error;
  for (const Measurement& one : results.measurements) {
    if (one.setting.which != &which || !(one.error > 0.0)) continue;
    time.push_back(one.cpu.median);
    error.push_back(one.error);
    const std::string& knob = one.setting.knob;
    auto series = std::find_if(plot.series.begin(), plot.series.end(), [&](const picture::Series& s) { return s.name == knob; });
    if (series == plot.series.end()) {
      plot.series.push_back({knob, picture::SeriesStyle::points, {}, {}});
      series = plot.series.end() - 1;
    }
    series->x.push_back(one.cpu.median);
    series->y.push_back(one.error);
  }
  picture::Series front{"Pareto front", picture::SeriesStyle::line, {}, {}};
  for (const std::size_t k : paretoFront(time, error)) {
    front.x.push_back(time[k]);
    front.y.push_back(error[k]);
  }
  plot.series.push_back(front);
  plot.lines.push_back({picture::ReferenceLine::Direction::vertical, 1.0, "real time on one core"});
  return plot;
}

/// Error against one knob, a line for each case.
picture::LinePlot knobPlot(const AccuracyResults& results, const std::string& knob, const std::string& label,
                           double (*value)(const Knobs&)) {
  picture::LinePlot plot;
  plot.title = "Error against " + label;
  plot.x = {label, true, {}, {}};
  plot.y = {"error", true, {}, {}};
  for (const ValidationCase* which : casesIn(results)) {
    std::vector<std::pair<double, double>> points;
    for (const Measurement& one : results.measurements) {
      if (one.setting.which != which || !(one.error > 0.0)) continue;
      if (one.setting.knob == knob || one.setting.knob == "base") points.emplace_back(value(one.setting.knobs), one.error);
    }
    if (points.size() < 2) continue;
    std::sort(points.begin(), points.end());
    picture::Series series{std::string{which->name}, picture::SeriesStyle::line_with_points, {}, {}};
    for (const auto& [x, y] : points) {
      series.x.push_back(x);
      series.y.push_back(y);
    }
    plot.series.push_back(series);
  }
  return plot;
}

nlohmann::json toJson(const Spread& spread) { return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}}; }

nlohmann::json toJson(const Setting& setting) {
  const Knobs& knobs = setting.knobs;
  return {{"case", std::string{setting.which->name}},
          {"knob", setting.knob},
          {"across", knobs.across},
          {"support_ratio", knobs.support_ratio},
          {"mach_factor", knobs.mach_factor},
          {"cfl", knobs.cfl},
          {"precision", knobs.precision == sph::Precision::float64 ? "double" : "float"},
          {"threads", knobs.threads}};
}

std::string measurementTable(const AccuracyResults& results) {
  std::string text =
      "| case | settings | error | real-time factor | N | us per particle-step | runs |\n|---|---|---|---|---|---|---|\n";
  for (const ValidationCase* which : casesIn(results)) {
    for (const Measurement& one : results.measurements) {
      if (one.setting.which != which) continue;
      text += fmt::format("| {} | {} | {} | {:.3g} | {} | {} | {} |\n", which->name, settingText(one.setting.knobs),
                          percent(one.error), one.realTimeFactor(), one.particles, spreadText(one.microseconds), one.runs);
    }
  }
  return text;
}

std::string separatedTable(const AccuracyResults& results) {
  std::string text =
      "| case, figure | error | finer spacing changes it by | shorter steps | twice the Mach factor | double | order in dx |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const ValidationCase* which : casesIn(results)) {
    const SeparatedErrors errors = separate(results.measurements, *which);
    text += fmt::format("| {}, {} | {} | {} | {} | {} | {} | {} |\n", which->name, which->error_figure, percent(errors.total),
                        percent(errors.spacing), percent(errors.time_step), percent(errors.compressibility),
                        percent(errors.precision), errors.spacing_order ? fmt::format("{:.1f}", *errors.spacing_order) : "-");
  }
  return text;
}

template <class Plot>
Status addPlot(const std::string& folder, const std::string& name, const Plot& plot, std::string& text) {
  if (plot.series.empty()) return {};
  std::string picture;
  if (Status status = writeSmallPlot(folder, name, plot, picture); !status.ok()) return status;
  text += picture.empty() ? fmt::format("\nCurves: `{}.csv`\n", name) : fmt::format("\n![{}]({})\n", name, picture);
  return {};
}

}  // namespace

std::string csvOf(const AccuracyResults& results) {
  std::string text =
      "case,knob,across,support_ratio,mach_factor,cfl,precision,threads,figure,value,error,particles,steps,runs,"
      "cpu_s_per_s,cpu_low,cpu_high,wall_s_per_s,wall_low,wall_high,real_time_factor,us_per_particle_step,us_low,us_high\n";
  for (const Measurement& one : results.measurements) {
    const Knobs& knobs = one.setting.knobs;
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{:.9g},{:.9g},{},{},{},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},"
        "{:.5g},{:.5g},{:.5g}\n",
        one.setting.which->name, one.setting.knob, knobs.across, knobs.support_ratio, knobs.mach_factor, knobs.cfl,
        knobs.precision == sph::Precision::float64 ? "double" : "float", knobs.threads, one.setting.which->error_figure,
        one.value, one.error, one.particles, one.steps, one.runs, one.cpu.median, one.cpu.low, one.cpu.high, one.wall.median,
        one.wall.low, one.wall.high, one.realTimeFactor(), one.microseconds.median, one.microseconds.low, one.microseconds.high);
  }
  return text;
}

std::string tablesOf(const AccuracyResults& results) {
  std::string text = measurementTable(results);
  text +=
      "\nReal-time factor: simulated over wall time. Microseconds: CPU time, median (lowest-highest) of the runs.\n\n"
      "Where the errors come from: by how much of the reference a figure changes when one knob goes on from the base (20 across, "
      "h "
      "= 2.5 dx, Mach 10, CFL 0.4) to its finest measured value.\n\n";
  text += separatedTable(results);
  if (results.left_out.empty()) return text;
  text += fmt::format("\nLeft out of the {} minutes:\n\n", results.minutes);
  for (const LeftOut& one : results.left_out) {
    text +=
        fmt::format("- {}, {} ({}): {}\n", one.setting.which->name, one.setting.knob, settingText(one.setting.knobs), one.reason);
  }
  return text;
}

nlohmann::json toJson(const AccuracyResults& results) {
  nlohmann::json measurements = nlohmann::json::array();
  for (const Measurement& one : results.measurements) {
    nlohmann::json row = toJson(one.setting);
    row["figure"] = std::string{one.setting.which->error_figure};
    row["value"] = one.value;
    row["error"] = one.error;
    row["particles"] = one.particles;
    row["steps"] = one.steps;
    row["runs"] = one.runs;
    row["cpu_s_per_s"] = toJson(one.cpu);
    row["wall_s_per_s"] = toJson(one.wall);
    row["real_time_factor"] = one.realTimeFactor();
    row["us_per_particle_step"] = toJson(one.microseconds);
    measurements.push_back(std::move(row));
  }
  nlohmann::json left_out = nlohmann::json::array();
  for (const LeftOut& one : results.left_out) {
    nlohmann::json row = toJson(one.setting);
    row["reason"] = one.reason;
    left_out.push_back(std::move(row));
  }
  return {{"machine", toJson(results.machine)},
          {"minutes", results.minutes},
          {"took_s", results.took},
          {"measurements", std::move(measurements)},
          {"left_out", std::move(left_out)}};
}

Status writeReport(const std::string& folder, const AccuracyResults& results) {
  if (Status status = writeTextFile(folder, "accuracy.csv", csvOf(results)); !status.ok()) return status;
  std::string text = fmt::format("# Accuracy against time\n\n{}. {:.0f} of {} minutes.\n\n{}", lineOf(results.machine),
                                 results.took / 60.0, results.minutes, tablesOf(results));
  for (const ValidationCase* which : casesIn(results)) {
    if (Status status = addPlot(folder, fmt::format("work_{}", which->name), workPlot(results, *which), text); !status.ok())
      return status;
  }
  const auto across = [](const Knobs& knobs) { return double(knobs.across); };
  const auto cfl = [](const Knobs& knobs) { return knobs.cfl; };
  const auto mach = [](const Knobs& knobs) { return knobs.mach_factor; };
  if (Status s = addPlot(folder, "spacing", knobPlot(results, "spacing", "particles across", across), text); !s.ok()) return s;
  if (Status s = addPlot(folder, "time_step", knobPlot(results, "cfl", "CFL number", cfl), text); !s.ok()) return s;
  if (Status s = addPlot(folder, "compressibility", knobPlot(results, "mach", "Mach factor", mach), text); !s.ok()) return s;
  if (results.effects) {
    if (Status s =
            addPlot(folder, "effects_cost", costPlot(*results.effects, "Cost of each effect, h = 2.5 dx", "on alone"), text);
        !s.ok())
      return s;
  }
  return writeTextFile(folder, "accuracy.md", text);
}

}  // namespace bleedsim::lab
