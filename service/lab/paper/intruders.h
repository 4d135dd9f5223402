// Fig. 2 of the paper, in two dimensions: a block at rest, and a few fast particles that pass through it, with and without the
// repulsion (36). The intruders come at the start, into a block that is still whole.
//
// Each case runs kIntruderSeeds times with other jitters of the block; a figure is the mean over them, its scatter the standard
// error.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "service/lab/measured.h"
#include "service/lab/paper/claim.h"
#include "service/lab/paper/paper_options.h"
#include "service/status/status.h"

namespace bleedsim::lab {

inline constexpr int kIntruderSeeds = 5;  ///< counted from the scene's own

/// What has become of the block and the intruders, in one run.
struct IntruderFigures {
  double time = 0.0;             ///< s
  double edge_moved = 0.0;       ///< m, mean distance of the block's outermost particles from where they were
  double inner_moved = 0.0;      ///< m, of the others
  double block_moved = 0.0;      ///< m, of the block's centre
  double intruders_moved = 0.0;  ///< m, mean
  double overlap = 0.0;          ///< m^2, largest sharedArea() of intruders and block during the passage
  double overlap_time = 0.0;     ///< s, when that was
  double momentum_drift = 0.0;   ///< |P - P0| over the intruders' momentum at the start; 0 without intruders
};

/// When the intruders, flying on, would touch the block's near face and leave its far one, s.
struct Passage {
  double enter = 0.0, leave = 0.0;
  double middle() const { return 0.5 * (enter + leave); }
};
/// Of the scene's blocks from the second on through the first. Zero where none flies at it.
Passage passageOf(const sph::WorldDescription& scene);

/// Area that lies within `radius` of one of the first `block` positions and of one of the others, by raster of radius/16.
double sharedArea(std::span<const float> positions, std::size_t block, double radius);

struct IntruderRun {
  std::string name;
  bool repulsion = false;
  bool intruders = false;
  std::string failure;
  std::vector<IntruderFigures> passage;  ///< by seed, when intruders have had the time to pass the block and as much again
  std::vector<IntruderFigures> figures;  ///< by seed, at the end: of a block at rest after the options' duration, else the same
  std::vector<float> positions;          ///< m, by id, of the first seed: in the middle of the passage, or of rest at the end
  double pictured_time = 0.0;            ///< s, of the positions
  std::uint32_t block_count = 0;         ///< the first ones are the block's

  Measured figure(double IntruderFigures::*figure) const;
};

/// The scene's first block is at rest, the others are the intruders.
Result<std::vector<IntruderRun>> runIntruders(const sph::WorldDescription& scene, const PaperOptions& options,
                                              const ProgressReport& progress);

/// The sentences of Fig. 2, judged by the runs of one model.
std::vector<Claim> judgeIntruders(const std::vector<IntruderRun>& runs, double spacing, const std::string& model);

Result<PaperReport> runFig2(const PaperOptions& options, const ProgressReport& progress);

}  // namespace bleedsim::lab
