// Fig. 2 of the paper, in two dimensions: a block at rest, and a few fast particles that pass through it, with and without the
// repulsion (36). The intruders come at the start, into a block that is still whole.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "service/lab/paper/paper_options.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// What has become of the block and the intruders.
struct IntruderFigures {
  double time = 0.0;             ///< s
  double edge_moved = 0.0;       ///< m, mean distance of the block's outermost particles from where they were
  double inner_moved = 0.0;      ///< m, of the others
  double block_moved = 0.0;      ///< m, of the block's centre
  double intruders_moved = 0.0;  ///< m, mean
  double overlap = 0.0;          ///< part of the particles' area that lies within another particle
  double momentum_drift = 0.0;   ///< |P - P0| over the intruders' momentum at the start; 0 without intruders
};

/// Part of the area of discs of `radius` about x, y that is covered twice: 1 - union/sum, by raster of radius/8.
double overlapOf(std::span<const float> positions, double radius);

struct IntruderRun {
  std::string name;
  bool repulsion = false;
  bool intruders = false;
  std::string failure;
  IntruderFigures passage;        ///< when intruders have had the time to pass the block
  IntruderFigures figures;        ///< at the end: of a block at rest after the options' duration, else the same
  std::vector<float> positions;   ///< m, by id
  std::uint32_t block_count = 0;  ///< the first ones are the block's
};

/// The scene's first block is at rest, the others are the intruders.
Result<std::vector<IntruderRun>> runIntruders(const sph::WorldDescription& scene, const PaperOptions& options,
                                              const ProgressReport& progress);

Result<PaperReport> runFig2(const PaperOptions& options, const ProgressReport& progress);

}  // namespace bleedsim::lab
