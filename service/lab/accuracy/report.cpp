#include "service/lab/accuracy/report.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "service/lab/accuracy/chapter.h"
#include "service/lab/lab_files.h"

namespace bleedsim::lab {
namespace {

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

nlohmann::json toJson(const std::optional<CostDifference>& difference) {
  if (!difference) return nullptr;
  return {{"us", difference->microseconds.value}, {"scatter", difference->microseconds.scatter}};
}

nlohmann::json toJson(const EffectCosts& costs) {
  nlohmann::json effects = nlohmann::json::array();
  for (const EffectCost& effect : costs.effects) {
    effects.push_back({{"name", effect.name}, {"alone", toJson(effect.alone)}, {"without", toJson(effect.without)}});
  }
  return {{"particles", costs.particles},
          {"turns", costs.turns},
          {"nothing_us", costs.nothing.microseconds.value},
          {"all_us", costs.scene.microseconds.value},
          {"effects", std::move(effects)}};
}

}  // namespace

std::string csvOf(const AccuracyResults& results) {
  std::string text =
      "case,knob,across,support_ratio,mach_factor,cfl,precision,threads,figure,value,error,particles,steps,runs,"
      "cpu_s_per_s,cpu_low,cpu_high,wall_s_per_s,wall_low,wall_high,real_time_factor,us_per_particle_step,us_low,us_high\n";
  for (const Measurement& one : results.measurements) {
    const Knobs& knobs = one.setting.knobs;
    const std::string setting =
        fmt::format("{},{},{},{},{},{},{},{}", one.setting.which->name, one.setting.knob, knobs.across, knobs.support_ratio,
                    knobs.mach_factor, knobs.cfl, knobs.precision == sph::Precision::float64 ? "double" : "float", knobs.threads);
    const std::string cost =
        fmt::format("{},{},{},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g}", one.particles, one.steps,
                    one.runs, one.cpu.median, one.cpu.low, one.cpu.high, one.wall.median, one.wall.low, one.wall.high,
                    one.realTimeFactor(), one.microseconds.median, one.microseconds.low, one.microseconds.high);
    for (const Figure& figure : one.figures)
      text += fmt::format("{},{},{:.9g},{:.9g},{}\n", setting, figure.name, figure.value, figure.error, cost);
  }
  return text;
}

nlohmann::json toJson(const AccuracyResults& results) {
  nlohmann::json measurements = nlohmann::json::array();
  for (const Measurement& one : results.measurements) {
    nlohmann::json row = toJson(one.setting);
    nlohmann::json figures = nlohmann::json::array();
    for (const Figure& figure : one.figures) {
      figures.push_back({{"name", figure.name}, {"value", figure.value}, {"error", figure.error}});
      if (figure.reference) figures.back()["reference"] = *figure.reference;
    }
    row["error"] = one.figures.front().error;
    row["figures"] = std::move(figures);
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
    if (one.needs) row["needs_s"] = *one.needs;
    left_out.push_back(std::move(row));
  }
  nlohmann::json json{{"machine", toJson(results.machine)},
                      {"minutes", results.minutes},
                      {"took_s", results.took},
                      {"measurements", std::move(measurements)},
                      {"left_out", std::move(left_out)}};
  if (results.effects) json["effects"] = toJson(*results.effects);
  return json;
}

Status writeReport(const std::string& folder, const AccuracyResults& results, std::vector<WrittenPlot>& plots) {
  if (Status status = writeTextFile(folder, "accuracy.csv", csvOf(results)); !status.ok()) return status;
  auto written = writePlots(folder, results);
  if (!written) return written.status();
  plots = std::move(*written);
  return writeTextFile(folder, "accuracy.md",
                       "# Accuracy against time\n\n" + chapterOf(results) + "\n## Every setting\n\n" + measurementTable(results) +
                           "\n## Plots\n" + picturesOf(plots, ""));
}

}  // namespace bleedsim::lab
