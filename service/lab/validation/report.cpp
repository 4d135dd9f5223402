#include "service/lab/validation/report.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "service/lab/lab_files.h"
#include "service/lab/percent_text.h"

namespace bleedsim::lab {
namespace {

std::string withUnit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, unit);
}

nlohmann::json toJson(const Figure& figure) {
  nlohmann::json json{
      {"name", figure.name}, {"value", figure.value}, {"error", figure.error}, {"grade", std::string{gradeName(figure.grade())}}};
  if (figure.reference) json["reference"] = *figure.reference;
  if (figure.bound) json["bound"] = *figure.bound;
  if (!figure.unit.empty()) json["unit"] = figure.unit;
  return json;
}

nlohmann::json toJson(const RunCost& cost) {
  return {{"steps", cost.steps},    {"particles", cost.particles}, {"simulated_s", cost.simulated},
          {"cpu_s", cost.cpu},      {"wall_s", cost.wall},         {"us_per_particle_step", cost.microseconds()},
          {"clamped", cost.clamped}};
}

std::string numberOf(const ValidationCase& one) { return one.number > 0 ? std::to_string(one.number) : "-"; }

/// How many figures got each grade, cases that did not run last.
std::string countsOf(const ValidationRun& run) {
  std::array<int, 3> counts{};
  int failed = 0;
  for (const CaseOutcome& outcome : run.outcomes) {
    if (!outcome.status.ok()) ++failed;
    for (const Figure& figure : outcome.result.figures) ++counts[static_cast<std::size_t>(figure.grade())];
  }
  std::string text =
      fmt::format("{} figures hold their threshold, {} miss it, {} are reported without one.", counts[0], counts[1], counts[2]);
  if (failed > 0) text += fmt::format(" {} cases could not be run.", failed);
  return text;
}

}  // namespace

std::string lineOf(const Knobs& knobs) {
  return fmt::format("h = {} dx, {} across, Mach factor {}, CFL {}, {}, {} thread{}", knobs.support_ratio, knobs.across,
                     knobs.mach_factor, knobs.cfl, knobs.precision == sph::Precision::float64 ? "double" : "float", knobs.threads,
                     knobs.threads == 1 ? "" : "s");
}

std::string tableOf(const ValidationRun& run) {
  std::string text = "| case | figure | found | reference | error | threshold | |\n|---|---|---|---|---|---|---|\n";
  for (const CaseOutcome& outcome : run.outcomes) {
    const std::string name = fmt::format("{} {}", numberOf(*outcome.which), outcome.which->name);
    if (!outcome.status.ok()) text += fmt::format("| {} | | | | | | could not be run: {} |\n", name, outcome.status.message());
    for (const Figure& figure : outcome.result.figures) {
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, figure.name, withUnit(figure.value, figure.unit),
                          figure.reference ? withUnit(*figure.reference, figure.unit) : "-", percentText(figure.error),
                          percentText(figure.bound), gradeName(figure.grade()));
    }
    for (const std::string& note : outcome.result.notes) text += fmt::format("| {} | | | | | | {} |\n", name, note);
  }
  return text + "\n" + countsOf(run) + "\n";
}

nlohmann::json toJson(const ValidationRun& run) {
  nlohmann::json cases = nlohmann::json::array();
  for (const CaseOutcome& outcome : run.outcomes) {
    nlohmann::json figures = nlohmann::json::array();
    for (const Figure& figure : outcome.result.figures) figures.push_back(toJson(figure));
    nlohmann::json one{{"name", std::string{outcome.which->name}},
                       {"number", outcome.which->number},
                       {"measures", std::string{outcome.which->measures}},
                       {"reference", std::string{outcome.which->reference}},
                       {"figures", std::move(figures)},
                       {"cost", toJson(outcome.result.cost)}};
    if (!outcome.status.ok()) one["failed"] = outcome.status.message();
    if (!outcome.result.notes.empty()) one["notes"] = outcome.result.notes;
    cases.push_back(std::move(one));
  }
  return {{"preset", run.knobs.preset == Preset::fine ? "fine" : "standard"},
          {"knobs", lineOf(run.knobs)},
          {"machine", toJson(run.machine)},
          {"cases", std::move(cases)}};
}

std::vector<std::string> missesOf(const ValidationRun& run) {
  std::vector<std::string> misses;
  for (const CaseOutcome& outcome : run.outcomes) {
    if (!outcome.status.ok())
      misses.push_back(fmt::format("{} could not be run: {}", outcome.which->name, outcome.status.message()));
    for (const Figure& figure : outcome.result.figures) {
      if (figure.grade() != Grade::misses) continue;
      misses.push_back(fmt::format("{} misses its threshold: {} is {}, off by {}; {} are allowed", outcome.which->name,
                                   figure.name, withUnit(figure.value, figure.unit), percentText(figure.error),
                                   percentText(figure.bound)));
    }
  }
  return misses;
}

Status writeReport(const std::string& folder, const ValidationRun& run) {
  std::string text = fmt::format("# Validation\n\n{}, thresholds of the preset {}.\n{}.\n\n{}", lineOf(run.knobs),
                                 run.knobs.preset == Preset::fine ? "fine" : "standard", lineOf(run.machine), tableOf(run));
  for (const CaseOutcome& outcome : run.outcomes) {
    const ValidationCase& which = *outcome.which;
    text += fmt::format("\n## {}\n\n{}. Reference: {}.", which.name, which.measures, which.reference);
    const RunCost& cost = outcome.result.cost;
    if (cost.steps > 0) {
      text += fmt::format(" Up to {} particles, {} steps, {:.1f} s CPU time, {:.3f} us per particle and step.", cost.particles,
                          cost.steps, cost.cpu, cost.microseconds());
    }
    if (cost.clamped > 0)
      text += fmt::format(" The solver cut {} accelerations or speeds of particles to its bounds.", cost.clamped);
    text += "\n";
    const auto misses = [](const Figure& figure) { return figure.grade() == Grade::misses; };
    const bool missed = std::any_of(outcome.result.figures.begin(), outcome.result.figures.end(), misses);
    if (missed && !which.shortfall.empty()) text += fmt::format("\nWhat misses: {}\n", which.shortfall);
    for (const CasePlot& plot : outcome.result.plots) {
      std::string picture;
      if (Status status = writeSmallPlot(folder, plot.name, plot.plot, picture); !status.ok()) return status;
      text += picture.empty() ? fmt::format("\nCurves: `{}.csv`\n", plot.name) : fmt::format("\n![{}]({})\n", plot.name, picture);
    }
  }
  return writeTextFile(folder, "report.md", text);
}

}  // namespace bleedsim::lab
