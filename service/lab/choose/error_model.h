// How wrong a scene is at a resolution: the profile of a film that flows (case incline) by the rows across the scene's narrowest
// place, error = a rows^-p of measured runs, and the largest compression, k/mach^2 of the scene's own runs.
#pragma once

#include <filesystem>
#include <map>
#include <span>

#include "service/lab/choose/time_model.h"
#include "service/lab/validation/case.h"

namespace bleedsim::lab {

/// Error of the case that stands for flow over tissue, by rows.
struct FlowPoint {
  double support_ratio = 0.0;
  double rows = 0.0;
  double error = 0.0;
};

inline constexpr std::string_view kFlowCase = "incline";

/// The case at so many rows, h/dx of the knobs.
Result<FlowPoint> measureFlow(double support_ratio, int rows, const sph::WorldOptions& options);

/// Those of a file that `bleedlab accuracy --json` wrote. not_found or invalid_argument with what is wrong with it.
Result<std::vector<FlowPoint>> readFlowPoints(const std::filesystem::path& file);

struct PredictedError {
  double flow = 0.0;
  double compression = 0.0;
  double total() const { return flow + compression; }
};

class ErrorModel {
 public:
  /// Fits each support ratio that has at least two points; `compression` is k by support ratio.
  ErrorModel(std::span<const FlowPoint> points, std::map<double, double> compression);

  bool knows(double support_ratio) const { return fits_.contains(support_ratio) && compression_.contains(support_ratio); }
  PredictedError predict(double support_ratio, double rows, double mach_factor) const;
  /// p of the support ratio's fit.
  double order(double support_ratio) const { return fits_.at(support_ratio).order; }

 private:
  struct Fit {
    double coefficient = 0.0;
    double order = 0.0;
  };
  std::map<double, Fit> fits_;
  std::map<double, double> compression_;
};

}  // namespace bleedsim::lab
