// The claims of the paper that stand in no figure: the forms of pressure, the kernels, the frame rate, the wounds.
#pragma once

#include <cstdint>
#include <vector>

#include "service/lab/paper/claim.h"
#include "service/lab/paper/paper_options.h"
#include "service/lab/paper/table2.h"
#include "service/scene/scene.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// (16) costs more than (17): the pool of the scene with pressure alone, both forms in turns.
Result<Claim> pressureCostClaim(const sph::WorldDescription& pool, const PaperOptions& options);
/// (17) is more accurate at edges: the acceleration that a linear pressure gives within one support radius of a block's face,
/// against -grad p/rho; on a cubic lattice, densities by (20).
/// `support`: h/dx.
Claim edgeErrorClaim(double support);
/// (17) is more accurate: the energy of an inviscid periodic box after the scene's horizon_s, beside (16), in both models.
Result<Claim> energyClaim(const scene::SceneDescription& box, const scene::SceneDescription& literal_box,
                          const PaperOptions& options);

/// The periodic cube of particles on which the kernels are compared. Lengths in spacings, times in dx/c0.
struct KernelCube {
  int side = 0;          ///< particles along it
  double support = 0.0;  ///< h
  double jitter = 0.0;
  double dt = 0.0;
  int steps = 0;
  std::uint64_t seed = 1;  ///< the first of kKernelSeeds
};
inline constexpr int kKernelSeeds = 5;
/// Of the scene's block, resolution, max_dt_s, horizon_s and seed; invalid_argument if it is no periodic cube.
Result<KernelCube> kernelCubeOf(const scene::SceneDescription& scene);

/// poly6 for pressure clusters particles: nearest neighbours in a periodic cube that settles under pressure.
Claim clusterClaim(const KernelCube& cube);
/// The Laplacians of poly6 and spiky are negative in a range.
Claim laplacianClaim();
/// Viscosity from them speeds particles up: what the viscous force does to the kinetic energy of random velocities.
Claim viscousGrowthClaim(const KernelCube& cube);

/// Frame rates: inversely proportional to the count, and 20 a second reached.
std::vector<Claim> rateClaims(const RateTable& table);
/// Wounds may differ in position and shape: each brings its flow's volume within the scene's horizon_s.
Result<Claim> woundClaim(const scene::SceneDescription& scene, const PaperOptions& options);

Result<PaperReport> runClaims(const PaperOptions& options, const ProgressReport& progress);

}  // namespace bleedsim::lab
