// The resolution that a budget allows: a search over spacing, support radius and Mach factor by the models of time and error.
#pragma once

#include <functional>
#include <optional>

#include "service/lab/choose/error_model.h"
#include "service/lab/choose/time_model.h"

namespace bleedsim::lab {

/// Time and error of a setting, however they are known.
struct ChoiceModels {
  std::vector<double> support_ratios;
  std::function<FrameTime(double support_ratio, double spacing, double mach_factor)> time;
  std::function<PredictedError(double support_ratio, double spacing, double mach_factor)> error;
};

struct ChoiceRequest {
  double budget_ms = 16.0;
  std::optional<double> error;  ///< that must not be exceeded; none: the smallest that fits
  double feature = 0.0;         ///< the scene's narrowest place, m
};

struct Choice {
  double spacing = 0.0;
  double support_ratio = 0.0;
  double mach_factor = 0.0;
  FrameTime time;
  PredictedError error;
};

inline constexpr double kLeastAcross = 2.0;  ///< particles across the narrowest place; fewer show nothing of it
inline constexpr double kBudgetPart = 0.9;   ///< of the budget that is planned with: predictions are off by some

/// With an error the fastest setting that keeps it, else the most accurate one within the budget. capacity with the figure that
/// decides if there is none.
Result<Choice> choose(const ChoiceModels& models, const ChoiceRequest& request);

}  // namespace bleedsim::lab
