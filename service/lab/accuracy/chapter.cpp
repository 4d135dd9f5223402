#include "service/lab/accuracy/chapter.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <functional>

#include "service/lab/percent_text.h"

namespace bleedsim::lab {
namespace {

std::string spreadText(const Spread& spread) {
  return fmt::format("{:.3g} ({:.3g}-{:.3g})", spread.median, spread.low, spread.high);
}

/// The knob that a setting moves, with its value: the head of its column.
std::string columnName(const Setting& setting) {
  const Knobs& knobs = setting.knobs;
  if (setting.knob == "spacing") return fmt::format("{} across", knobs.across);
  if (setting.knob == "support") return fmt::format("h = {} dx", knobs.support_ratio);
  if (setting.knob == "mach") return fmt::format("Mach {}", knobs.mach_factor);
  if (setting.knob == "cfl") return fmt::format("CFL {}", knobs.cfl);
  if (setting.knob == "precision") return "double";
  if (setting.knob == "threads") return fmt::format("{} threads", knobs.threads);
  return "base";
}

/// The base, then knob by knob, its values rising.
std::vector<std::string> columnsOf(const AccuracyResults& results) {
  std::vector<const Setting*> settings;
  for (const Measurement& one : results.measurements) settings.push_back(&one.setting);
  const auto place = [](const Setting& setting) {
    const std::vector<std::string>& names = knobNames();
    const auto knob = std::find(names.begin(), names.end(), setting.knob);
    const Knobs& knobs = setting.knobs;
    return std::make_pair(setting.knob == "base" ? -1 : static_cast<int>(knob - names.begin()),
                          knobs.across + knobs.support_ratio + knobs.mach_factor + knobs.cfl + knobs.threads);
  };
  std::stable_sort(settings.begin(), settings.end(), [&](const Setting* a, const Setting* b) { return place(*a) < place(*b); });
  std::vector<std::string> columns;
  for (const Setting* setting : settings) {
    if (std::find(columns.begin(), columns.end(), columnName(*setting)) == columns.end()) columns.push_back(columnName(*setting));
  }
  return columns;
}

const Measurement* findMeasurement(const AccuracyResults& results, const ValidationCase& which, const std::string& column) {
  const auto found = std::find_if(results.measurements.begin(), results.measurements.end(), [&](const Measurement& one) {
    return one.setting.which == &which && columnName(one.setting) == column;
  });
  return found == results.measurements.end() ? nullptr : &*found;
}

/// A row of the name and a cell for each column.
std::string row(const std::string& name, const std::vector<std::string>& columns,
                const std::function<std::string(const std::string&)>& cell) {
  std::string text = fmt::format("| {} |", name);
  for (const std::string& column : columns) text += fmt::format(" {} |", cell(column));
  return text + "\n";
}

std::string headOf(const std::string& name, const std::vector<std::string>& columns) {
  std::string text = row(name, columns, [](const std::string& column) { return column; });
  for (std::size_t k = 0; k <= columns.size(); ++k) text += "|---";
  return text + "|\n";
}

std::string errorTable(const AccuracyResults& results) {
  const std::vector<std::string> columns = columnsOf(results);
  std::string text = headOf("error of", columns);
  for (const ValidationCase* which : casesIn(results)) {
    for (const std::string_view figure : errorFiguresOf(*which)) {
      text += row(fmt::format("`{}` {}", which->name, figure), columns, [&](const std::string& column) -> std::string {
        const Measurement* one = findMeasurement(results, *which, column);
        const Figure* found = one == nullptr ? nullptr : one->find(figure);
        return found == nullptr ? "-" : percentText(found->error);
      });
    }
  }
  return text;
}

std::string timeTable(const AccuracyResults& results) {
  const std::vector<std::string> columns = columnsOf(results);
  std::string text = headOf("real-time factor, particles at the base", columns);
  for (const ValidationCase* which : casesIn(results)) {
    const Measurement* base = findMeasurement(results, *which, "base");
    const std::string particles = base == nullptr ? "-" : std::to_string(base->particles);
    text += row(fmt::format("`{}`, {}", which->name, particles), columns, [&](const std::string& column) -> std::string {
      const Measurement* one = findMeasurement(results, *which, column);
      return one == nullptr ? "-" : fmt::format("{:.2g}", one->realTimeFactor());
    });
  }
  return text + row("us per particle and step", columns, [&](const std::string& column) -> std::string {
           double low = 1e300;
           double high = 0.0;
           for (const Measurement& one : results.measurements) {
             if (columnName(one.setting) != column) continue;
             low = std::min(low, one.microseconds.median);
             high = std::max(high, one.microseconds.median);
           }
           return fmt::format("{:.2g} to {:.2g}", low, high);
         });
}

std::string separatedTable(const AccuracyResults& results) {
  std::string text =
      "| error of | at the base | finer spacing changes it by | shorter steps | a larger Mach factor | double | order in dx |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const ValidationCase* which : casesIn(results)) {
    for (const std::string_view figure : errorFiguresOf(*which)) {
      const SeparatedErrors errors = separate(results.measurements, *which, figure);
      text +=
          fmt::format("| `{}` {} | {} | {} | {} | {} | {} | {} |\n", which->name, figure, percentText(errors.total),
                      percentText(errors.spacing), percentText(errors.time_step), percentText(errors.compressibility),
                      percentText(errors.precision), errors.spacing_order ? fmt::format("{:.1f}", *errors.spacing_order) : "-");
    }
  }
  return text;
}

std::string costText(const std::optional<CostDifference>& difference) {
  if (!difference) return "-";
  if (!difference->counts()) return "not measurable";
  return fmt::format("{:.3f} ± {:.3f}", difference->microseconds.value, difference->microseconds.scatter);
}

std::string effectTable(const EffectCosts& costs) {
  std::string text = fmt::format(
      "What each effect costs, us of CPU time per particle and step: {} particles, {} turns; without any effect {:.2f}, with all "
      "{:.2f}.\n\n| effect | on alone | off alone saves |\n|---|---|---|\n",
      costs.particles, costs.turns, costs.nothing.microseconds.value, costs.scene.microseconds.value);
  for (const EffectCost& effect : costs.effects)
    text += fmt::format("| `{}` | {} | {} |\n", effect.name, costText(effect.alone), costText(effect.without));
  return text;
}

/// A line for each case: what of it was not measured, and why.
std::string leftOutList(const AccuracyResults& results) {
  std::string text = fmt::format("\nLeft out of the {} minutes, with what a run would have taken:\n\n", results.minutes);
  for (const ValidationCase& which : validationCases()) {
    std::string line;
    for (const LeftOut& one : results.left_out) {
      if (one.setting.which == &which)
        line += fmt::format("{}{} ({})", line.empty() ? "" : ", ", columnName(one.setting),
                            one.needs ? fmt::format("{:.{}f} s", *one.needs, *one.needs < 10.0 ? 1 : 0) : one.reason);
    }
    if (!line.empty()) text += fmt::format("- `{}`: {}\n", which.name, line);
  }
  return text;
}

}  // namespace

std::string settingText(const Knobs& knobs) {
  std::string text =
      fmt::format("{} across, h = {} dx, Mach {}, CFL {}", knobs.across, knobs.support_ratio, knobs.mach_factor, knobs.cfl);
  if (knobs.precision == sph::Precision::float64) text += ", double";
  if (knobs.threads > 1) text += fmt::format(", {} threads", knobs.threads);
  return text;
}

std::string measurementTable(const AccuracyResults& results) {
  std::string text =
      "| case | settings | error | real-time factor | N | us per particle-step | runs |\n|---|---|---|---|---|---|---|\n";
  for (const ValidationCase* which : casesIn(results)) {
    for (const Measurement& one : results.measurements) {
      if (one.setting.which != which) continue;
      std::string errors;
      for (const Figure& figure : one.figures)
        errors += fmt::format("{}{} {}", errors.empty() ? "" : ", ", figure.name, percentText(figure.error));
      text += fmt::format("| {} | {} | {} | {:.3g} | {} | {} | {} |\n", which->name, settingText(one.setting.knobs), errors,
                          one.realTimeFactor(), one.particles, spreadText(one.microseconds), one.runs);
    }
  }
  return text;
}

std::string chapterOf(const AccuracyResults& results) {
  std::string text = fmt::format("{}; {:.0f} of {} minutes.\n\n", lineOf(results.machine), results.took / 60.0, results.minutes);
  text += fmt::format("Base: {}, float, one thread. A column moves one knob; a dash was not measured.\n\n", settingText(Knobs{}));
  text += errorTable(results) + "\n" + timeTable(results);
  text +=
      "\nReal-time factor: simulated over wall time, median of the runs. Microseconds are CPU time, the smallest and the largest "
      "median of the cases.\n\nWhere the errors come from: by how much of the reference a figure changes when one knob goes on "
      "from "
      "the base to its finest measured value.\n\n";
  text += separatedTable(results);
  if (results.effects) text += fmt::format("\n{}", effectTable(*results.effects));
  if (!results.left_out.empty()) text += leftOutList(results);
  return text;
}

std::string picturesOf(const std::vector<WrittenPlot>& plots, const std::string& links) {
  std::string text;
  for (const WrittenPlot& one : plots) {
    text += one.picture.empty() ? fmt::format("\nCurves: `{}{}.csv`\n", links, one.name)
                                : fmt::format("\n![{}]({}{})\n", one.name, links, one.picture);
  }
  return text;
}

}  // namespace bleedsim::lab
