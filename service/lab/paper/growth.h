// Figs. 6 and 8 of the paper: how blood spreads from a wound, on flat tissue and in a hollow of an organ.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service/lab/paper/fit.h"
#include "service/lab/paper/paper_options.h"
#include "service/status/status.h"

namespace bleedsim::lab {

struct GrowthPoint {
  double time = 0.0;              ///< s
  std::uint32_t particles = 0;    ///< emitted
  double area = 0.0;              ///< of the footprint, m^2
  double largest_height = 0.0;    ///< over the wound's level, m
  std::optional<double> covered;  ///< part of the hollow's opening, seen from above; only with a bowl
};

struct Growth {
  std::vector<GrowthPoint> points;
  std::vector<std::vector<float>> positions;  ///< x, y, z at some of the points, m
  std::vector<std::size_t> pictured;          ///< those points
  PowerFit area_by_count;
  std::optional<std::uint32_t> covered_at;  ///< particles when kCovered of the hollow was first covered
};

inline constexpr double kCovered = 0.99;

/// The hollow's rim: of the first bowl of the scene.
struct Rim {
  double x = 0.0, y = 0.0, radius = 0.0;  ///< m
};
std::optional<Rim> rimOf(const sph::WorldDescription& scene);

/// Part of the disc of the rim over which there is blood.
double coveredPart(std::span<const float> positions, double spacing, const Rim& rim);

Result<Growth> growBlood(const sph::WorldDescription& scene, const PaperOptions& options, const ProgressReport& progress);

/// `name`: fig6 or fig8.
Result<PaperReport> runGrowth(const PaperOptions& options, const std::string& name, const ProgressReport& progress);

}  // namespace bleedsim::lab
