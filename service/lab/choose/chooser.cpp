#include "service/lab/choose/chooser.h"

#include <array>
#include <fmt/format.h>

namespace bleedsim::lab {
namespace {

constexpr std::array kMachFactors{5.0, 7.0, 10.0, 14.0, 20.0};
constexpr double kFinerBy = 0.95;
constexpr double kFinestSpacing = 1e-4;  // m: beyond it no scene of blood is real time

std::string settingText(const Choice& choice) {
  return fmt::format("dx = {:.2f} mm, h = {} dx, Mach factor {}", 1e3 * choice.spacing, choice.support_ratio, choice.mach_factor);
}

std::string costText(const FrameTime& time) {
  return fmt::format("{:.3g} ms a frame ({} particles, {:.0f} steps, {:.3f} us per particle-step)", time.milliseconds,
                     time.particles, time.steps, time.microseconds);
}

Status nothingFits(const ChoiceRequest& request, const std::optional<Choice>& cheapest,
                   const std::optional<Choice>& most_accurate) {
  if (!cheapest) {
    return {
        StatusCode::capacity,
        fmt::format("nothing keeps an error of {:.3g} %: the finest setting that was looked at, {}, has {:.3g} %; ask for more "
                    "with --error",
                    100.0 * *request.error, settingText(*most_accurate), 100.0 * most_accurate->error.total())};
  }
  const std::string what = request.error
                               ? fmt::format("the cheapest setting that keeps an error of {:.3g} %", 100.0 * *request.error)
                               : fmt::format("even with {:.0f} particles across the narrowest place of {:.2f} mm", kLeastAcross,
                                             1e3 * request.feature);
  return {StatusCode::capacity, fmt::format("nothing fits {} ms ({:.3g} ms with a reserve of a tenth): {} ({}) takes {}; raise "
                                            "--budget-ms{}, or make the scene smaller",
                                            request.budget_ms, kBudgetPart * request.budget_ms, what, settingText(*cheapest),
                                            costText(cheapest->time), request.error ? " or --error" : "")};
}

}  // namespace

Result<Choice> choose(const ChoiceModels& models, const ChoiceRequest& request) {
  std::optional<Choice> best;           // within the budget and the error
  std::optional<Choice> cheapest;       // within the error
  std::optional<Choice> most_accurate;  // of all
  for (const double support : models.support_ratios) {
    for (const double mach : kMachFactors) {
      for (double spacing = request.feature / kLeastAcross; spacing >= kFinestSpacing; spacing *= kFinerBy) {
        const Choice choice{spacing, support, mach, models.time(support, spacing, mach), models.error(support, spacing, mach)};
        if (!most_accurate || choice.error.total() < most_accurate->error.total()) most_accurate = choice;
        if (request.error && choice.error.total() > *request.error) continue;
        if (!cheapest || choice.time.milliseconds < cheapest->time.milliseconds) cheapest = choice;
        if (choice.time.milliseconds > kBudgetPart * request.budget_ms) break;  // finer ones take longer
        const bool better = !best || (request.error ? choice.time.milliseconds < best->time.milliseconds
                                                    : choice.error.total() < best->error.total());
        if (better) best = choice;
      }
    }
  }
  if (best) return *best;
  if (!most_accurate) {
    return Status{
        StatusCode::invalid_argument,
        fmt::format("the narrowest place of {:.3g} mm is below what can be resolved; give --feature-mm", 1e3 * request.feature)};
  }
  return nothingFits(request, cheapest, most_accurate);
}

}  // namespace bleedsim::lab
