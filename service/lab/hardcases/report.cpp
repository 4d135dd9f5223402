#include "service/lab/hardcases/report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bleedsim::lab {
namespace {

struct Column {
  sph::Model model;
  EffectChoice effects;
  const char* title;
};
constexpr std::array kColumns{Column{sph::Model::sound, EffectChoice::all, "sound, all effects"},
                              Column{sph::Model::sound, EffectChoice::needed, "sound, needed effects"},
                              Column{sph::Model::literal, EffectChoice::needed, "literal"}};

const char* nameOf(sph::Precision precision) { return precision == sph::Precision::float32 ? "float" : "double"; }

std::string numberText(double value) {
  if (std::isnan(value)) return "no number";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return fmt::format("{:.3g}", value);
}

std::string boundText(const HardFigure& figure) {
  if (!figure.judged) return "";
  if (figure.lowest == figure.highest) return fmt::format(" (exactly {})", numberText(figure.lowest));
  if (std::isinf(figure.lowest)) return fmt::format(" (at most {})", numberText(figure.highest));
  if (std::isinf(figure.highest)) return fmt::format(" (at least {})", numberText(figure.lowest));
  return fmt::format(" ({} to {})", numberText(figure.lowest), numberText(figure.highest));
}

/// How much of its bound a figure takes: 1 at the bound, 0 where only one value holds.
double useOf(const HardFigure& figure) {
  if (!figure.judged || figure.lowest == figure.highest) return 0.0;
  double use = 0.0;
  if (std::isfinite(figure.highest) && figure.highest != 0.0) use = std::max(use, std::abs(figure.value / figure.highest));
  if (std::isfinite(figure.lowest) && figure.value != 0.0) use = std::max(use, std::abs(figure.lowest / figure.value));
  return use;
}

const HardOutcome* find(const CaseReport& report, const Column& column, sph::Precision precision) {
  for (std::size_t k = 0; k < report.setups.size(); ++k) {
    const CaseSetup& setup = report.setups[k];
    if (setup.model == column.model && setup.effects == column.effects && setup.precision == precision)
      return &report.outcomes[k];
  }
  return nullptr;
}

/// The judged figure nearest to its bound, with its value in double beside that in float; one that is told if none is judged.
std::string nearestFigure(const HardOutcome& outcome, const HardOutcome* other) {
  const auto nearest = std::max_element(
      outcome.figures.begin(), outcome.figures.end(),
      [](const HardFigure& a, const HardFigure& b) { return a.judged == b.judged ? useOf(a) < useOf(b) : b.judged; });
  if (nearest == outcome.figures.end()) return {};
  const auto index = static_cast<std::size_t>(nearest - outcome.figures.begin());
  const bool paired = other != nullptr && index < other->figures.size();
  return fmt::format("{} {}{}{}{}", nearest->name, numberText(nearest->value), paired ? " / " : "",
                     paired ? numberText(other->figures[index].value) : "", boundText(*nearest));
}

std::string cellOf(const CaseReport& report, const Column& column) {
  const HardOutcome* single = find(report, column, sph::Precision::float32);
  const HardOutcome* twice = find(report, column, sph::Precision::float64);
  if (single == nullptr) return "-";
  const bool both = twice == nullptr || single->holds() == twice->holds();
  if (single->holds() && both) return fmt::format("holds: {}", nearestFigure(*single, twice));
  std::string text = single->holds() ? "holds in float" : fmt::format("**fails**: {}", describeFailures(*single));
  if (!both && twice->holds()) text += "; holds in double";
  if (!both && !twice->holds()) text += fmt::format("; **fails in double**: {}", describeFailures(*twice));
  return text;
}

nlohmann::json toJson(const HardFigure& figure) {
  nlohmann::json json{{"name", figure.name}, {"value", figure.value}};
  if (!figure.judged) return json;
  if (std::isfinite(figure.lowest)) json["at_least"] = figure.lowest;
  if (std::isfinite(figure.highest)) json["at_most"] = figure.highest;
  json["holds"] = figure.holds();
  return json;
}

nlohmann::json toJson(const CaseSetup& setup, const HardOutcome& outcome) {
  nlohmann::json json{{"model", setup.model == sph::Model::sound ? "sound" : "literal"},
                      {"effects", setup.effects == EffectChoice::all ? "all" : "needed"},
                      {"precision", nameOf(setup.precision)},
                      {"holds", outcome.holds()}};
  if (!outcome.stopped.empty()) json["stopped"] = outcome.stopped;
  for (const HardFigure& figure : outcome.figures) json["figures"].push_back(toJson(figure));
  for (const HardFigure& figure : outcome.always) json["always"].push_back(toJson(figure));
  for (std::size_t k = 0; k < outcome.counters.size(); ++k) {
    if (outcome.counters[k] > 0)
      json["counters"][std::string{sph::counterName(static_cast<sph::Counter>(k))}] = outcome.counters[k];
  }
  return json;
}

}  // namespace

std::string describe(const HardFigure& figure) {
  return fmt::format("{} {}{}", figure.name, numberText(figure.value), boundText(figure));
}

std::string describeFailures(const HardOutcome& outcome) {
  std::string text = outcome.stopped.empty() ? "" : fmt::format("stopped: {}", outcome.stopped);
  for (const auto* figures : {&outcome.figures, &outcome.always}) {
    for (const HardFigure& figure : *figures) {
      if (!figure.holds()) text += fmt::format("{}{}", text.empty() ? "" : "; ", describe(figure));
    }
  }
  return text;
}

std::string describe(const CaseSetup& setup) {
  return fmt::format("{}, {} effects, {}", setup.model == sph::Model::sound ? "sound" : "literal",
                     setup.effects == EffectChoice::all ? "all" : "needed", nameOf(setup.precision));
}

std::string toMarkdown(const std::vector<CaseReport>& reports, const Machine& machine) {
  const auto shown = [&](const Column& column) {
    return std::any_of(reports.begin(), reports.end(),
                       [&](const CaseReport& report) { return find(report, column, sph::Precision::float32) != nullptr; });
  };
  std::string header = "| | asked |";
  std::string rule = "|---|---|";
  for (const Column& column : kColumns) {
    if (!shown(column)) continue;
    header += fmt::format(" {} |", column.title);
    rule += "---|";
  }
  std::string text = lineOf(machine) + ".\n\n" + header + "\n" + rule + "\n";
  for (const CaseReport& report : reports) {
    text += fmt::format("| {} `{}` | {} |", report.hard_case->number, report.hard_case->name, report.hard_case->asks);
    for (const Column& column : kColumns) {
      if (shown(column)) text += fmt::format(" {} |", cellOf(report, column));
    }
    text += "\n";
  }
  return text;
}

nlohmann::json toJson(const std::vector<CaseReport>& reports, const Machine& machine) {
  nlohmann::json cases = nlohmann::json::array();
  for (const CaseReport& report : reports) {
    nlohmann::json entry{
        {"number", report.hard_case->number}, {"name", report.hard_case->name}, {"asks", report.hard_case->asks}};
    for (std::size_t k = 0; k < report.setups.size(); ++k) entry["runs"].push_back(toJson(report.setups[k], report.outcomes[k]));
    cases.push_back(std::move(entry));
  }
  nlohmann::json json;
  json["machine"] = toJson(machine);
  json["cases"] = std::move(cases);
  return json;
}

}  // namespace bleedsim::lab
