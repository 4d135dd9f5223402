#include "service/lab/choose/error_model.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "service/lab/accuracy/work_precision.h"

namespace bleedsim::lab {
namespace {

/// `incline` has half as many rows as its knob `across`.
constexpr int kAcrossOfRow = 2;

Status damaged(const std::filesystem::path& file, const std::string& what) {
  return {StatusCode::invalid_argument,
          fmt::format("'{}' {}; give a file that `bleedlab accuracy --json FILE` wrote with the case {}", file.string(), what,
                      kFlowCase)};
}

}  // namespace

Result<FlowPoint> measureFlow(double support_ratio, int rows, const sph::WorldOptions& options) {
  const ValidationCase& which = *findCase(kFlowCase);
  Knobs knobs;
  knobs.across = kAcrossOfRow * rows;
  knobs.support_ratio = support_ratio;
  knobs.threads = options.threads;
  knobs.simd = options.simd;
  knobs.beside = false;
  const auto result = which.run(knobs);
  if (!result) return result.status();
  return FlowPoint{support_ratio, double(rows), result->find(which.error_figures.front())->error};
}

Result<std::vector<FlowPoint>> readFlowPoints(const std::filesystem::path& file) {
  std::ifstream stream{file, std::ios::binary};
  if (!stream)
    return Status{StatusCode::not_found, "cannot open '" + file.string() + "'; give a file of `bleedlab accuracy --json`"};
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (json.is_discarded() || !json.is_object() || !json.contains("measurements") || !json["measurements"].is_array())
    return damaged(file, "holds no measurements");
  std::vector<FlowPoint> points;
  const auto text_of = [](const nlohmann::json& row, const char* key) {
    return row.is_object() && row.contains(key) && row[key].is_string() ? row[key].get<std::string>() : std::string{};
  };
  for (const nlohmann::json& row : json["measurements"]) {
    if (text_of(row, "case") != kFlowCase) continue;
    const std::string knob = text_of(row, "knob");
    if (knob != "base" && knob != "spacing" && knob != "support") continue;
    for (const char* number : {"support_ratio", "across", "error"}) {
      if (!row.contains(number) || !row[number].is_number()) return damaged(file, fmt::format("has a row without {}", number));
    }
    const FlowPoint point{row["support_ratio"].get<double>(), row["across"].get<double>() / kAcrossOfRow,
                          row["error"].get<double>()};
    if (!(point.rows > 0.0) || !(point.error > 0.0) || !std::isfinite(point.error))
      return damaged(file, "has a row out of range");
    points.push_back(point);
  }
  if (points.empty()) return damaged(file, "has no row of the case");
  return points;
}

ErrorModel::ErrorModel(std::span<const FlowPoint> points, std::map<double, double> compression)
    : compression_{std::move(compression)} {
  std::map<double, std::pair<std::vector<double>, std::vector<double>>> by_support;
  for (const FlowPoint& point : points) {
    by_support[point.support_ratio].first.push_back(point.rows);
    by_support[point.support_ratio].second.push_back(point.error);
  }
  for (const auto& [support, columns] : by_support) {
    const auto& [rows, error] = columns;
    const auto order = convergenceOrder(rows, error);
    if (!order) continue;
    double logs = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k) logs += std::log(error[k]) + *order * std::log(rows[k]);
    fits_[support] = {std::exp(logs / static_cast<double>(rows.size())), *order};
  }
}

PredictedError ErrorModel::predict(double support_ratio, double rows, double mach_factor) const {
  const Fit& fit = fits_.at(support_ratio);
  return {fit.coefficient * std::pow(rows, -fit.order), compression_.at(support_ratio) / (mach_factor * mach_factor)};
}

}  // namespace bleedsim::lab
