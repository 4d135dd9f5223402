// The claims of the paper that stand in no figure: the forms of pressure, the kernels, the frame rate, the wounds.
#pragma once

#include <cstdint>
#include <vector>

#include "service/lab/paper/claim.h"
#include "service/lab/paper/paper_options.h"
#include "service/lab/paper/table2.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// (16) costs more than (17): the pool of the scene with pressure alone, both forms in turns.
Result<Claim> pressureCostClaim(const sph::WorldDescription& pool, const PaperOptions& options);
/// (17) is more accurate at edges: the acceleration that a linear pressure gives within one support radius of a block's face,
/// against -grad p/rho; on a cubic lattice, densities by (20).
Claim edgeErrorClaim();
/// (17) is more accurate: the energy of an inviscid periodic box after 200 spacings over the speed of sound, beside (16).
Result<Claim> energyClaim(const sph::WorldDescription& box, const PaperOptions& options);

/// poly6 for pressure clusters particles: nearest neighbours in a periodic cube that settles under pressure.
Claim clusterClaim();
/// The Laplacians of poly6 and spiky are negative in a range.
Claim laplacianClaim();
/// Viscosity from them speeds particles up: what the viscous force does to the kinetic energy of random velocities.
Claim viscousGrowthClaim();

/// Frame rates: inversely proportional to the count, and 20 a second reached.
std::vector<Claim> rateClaims(const RateTable& table);
/// Wounds may differ in position and shape: each brings its flow's volume.
Result<Claim> woundClaim(const sph::WorldDescription& scene, const PaperOptions& options);

Result<PaperReport> runClaims(const PaperOptions& options, const ProgressReport& progress);

}  // namespace bleedsim::lab
