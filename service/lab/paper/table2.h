// Table II of the paper: frames (= steps) per second by complete search and by the cube mesh, and whether they are inversely
// proportional to the number of particles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/lab/paper/claim.h"
#include "service/lab/paper/fit.h"
#include "service/lab/paper/paper_options.h"
#include "service/status/status.h"

namespace bleedsim::lab {

inline constexpr double kSmoothRate = 20.0;  ///< frames/s that the paper calls enough

enum class Search { complete, mesh };

struct RateRow {
  std::uint32_t particles = 0;
  Search search = Search::mesh;
  double rate = 0.0;         ///< steps per second by the lower quartile of a step's time: what others on the machine leave alone
  double median_rate = 0.0;  ///< by the median of a step's time: with what others do
  double scatter = 0.0;      ///< of the rate: median absolute deviation of the steps' rates
  double dt = 0.0;           ///< s, of the last step: rate x dt is simulated over wall time
  std::optional<double> paper_rate;  ///< frames per second of the paper, for its own counts
  std::uint32_t steps = 0;           ///< measured
};

struct RateFit {
  Search search = Search::mesh;
  PowerFit ours;
  PowerFit paper;
};

struct RateTable {
  std::vector<RateRow> rows;
  std::vector<RateFit> fits;  ///< with two counts or more
  std::string simd;
};

/// Whether a fit says "inversely proportional": an exponent of -1 +- kInverseWithin by twice its standard error, with 98 % of the
/// variance explained. does_not where the exponent lies outside by as much, depends where that straddles the bound, where the
/// line explains less or where its error is unknown.
inline constexpr double kInverseWithin = 0.1;
Verdict inverseVerdict(const PowerFit& fit);

/// The fluid and effects of the scene, its first block cut to the height that holds each count; all counts and both
/// searches in turns, as many as the options' seconds hold, at least one.
Result<RateTable> measureRates(const sph::WorldDescription& scene, const PaperOptions& options, const ProgressReport& progress);

Result<PaperReport> runTable2(const PaperOptions& options, const ProgressReport& progress);

}  // namespace bleedsim::lab
