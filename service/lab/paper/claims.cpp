#include "service/lab/paper/claims.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "service/lab/paper/paper_scene.h"

namespace bleedsim::lab {

std::vector<Claim> rateClaims(const RateTable& table) {
  Claim inverse{.sentence = "frame rate is inversely proportional to the number of particles",
                .figure = "exponent of frames/s over particles",
                .with = "claimed",
                .without = "here",
                .claimed = Direction::equal,
                .evidence = {},
                .verdict = Verdict::depends};
  for (const RateFit& fit : table.fits) {
    Evidence evidence = compare(fit.search == Search::mesh ? "mesh" : "complete", Measured{-1.0, 0.0},
                                Measured{fit.ours.exponent, fit.ours.exponent_error.value_or(0.0)}, Direction::equal);
    evidence.verdict = inverseVerdict(fit.ours);
    evidence.note = fmt::format("R^2 {:.3f}{}; the paper's own numbers: {:.2f} +- {:.2f}", fit.ours.r2,
                                fit.ours.exponent_error ? "" : ", of too few counts for an error", fit.paper.exponent,
                                fit.paper.exponent_error.value_or(0.0));
    inverse.evidence.push_back(std::move(evidence));
  }
  conclude(inverse);
  Claim enough{.sentence = "20 frames a second are reached with the cube mesh",
               .figure = "frames/s with the most particles",
               .with = "enough",
               .without = "here",
               .claimed = Direction::larger,
               .evidence = {},
               .verdict = Verdict::depends};
  const RateRow* most = nullptr;
  for (const RateRow& row : table.rows) {
    if (row.search == Search::mesh && (most == nullptr || row.particles > most->particles)) most = &row;
  }
  if (most != nullptr) {
    enough.evidence.push_back(
        compare("mesh", Measured{kSmoothRate, 0.0}, Measured{most->rate, most->scatter}, Direction::larger));
    enough.evidence.back().note = fmt::format(
        "{} particles, by the fastest quarter of the steps, {:.1f} by the median; one step a frame, as in the paper: "
        "{:.2g} s simulated in a second",
        most->particles, most->median_rate, most->rate * most->dt);
  }
  conclude(enough);
  return {inverse, enough};
}

Result<Claim> woundClaim(const scene::SceneDescription& scene, const PaperOptions& options) {
  const auto seconds = horizonOf(scene);
  if (!seconds) return seconds.status();
  auto world = sph::createWorld(scene.world, options.world());
  if (!world) return world.status();
  while ((*world)->time() < *seconds) {
    if (Status status = (*world)->step(std::numeric_limits<double>::infinity()); !status.ok()) return status;
  }
  Claim claim{.sentence = "wounds may differ in position and shape",
              .figure = "volume in mL",
              .with = "commanded",
              .without = "came",
              .claimed = Direction::equal,
              .evidence = {},
              .verdict = Verdict::depends};
  const auto wounds = (*world)->wounds();
  for (std::size_t k = 0; k < wounds.size() && k < scene.world.wounds.size(); ++k) {
    const double commanded = wounds[k].flow * (*world)->time();
    // What has come is a whole number of particles.
    claim.evidence.push_back(compare(scene.world.wounds[k].name, Measured{1e6 * commanded, 0.5e6 * scene.world.particleVolume()},
                                     Measured{1e6 * wounds[k].emitted, 0.0}, Direction::equal));
  }
  conclude(claim);
  return claim;
}

Result<PaperReport> runClaims(const PaperOptions& options, const ProgressReport& progress) {
  const auto pool = loadPaperScene(options, "table2");
  if (!pool) return pool.status();
  const auto box = loadPaperScene(options, "claims_box");
  if (!box) return box.status();
  const auto literal_box = loadPaperScene(options, "claims_box_literal");
  if (!literal_box) return literal_box.status();
  const auto kernels = loadPaperScene(options, "claims_kernels");
  if (!kernels) return kernels.status();
  const auto cube = kernelCubeOf(*kernels);
  if (!cube) return cube.status();
  const auto wounds = loadPaperScene(options, "claims_wounds");
  if (!wounds) return wounds.status();

  std::vector<Claim> claims;
  auto cost = pressureCostClaim(pool->world, options);
  if (!cost) return cost.status();
  claims.push_back(std::move(*cost));
  progress(0.2);
  claims.push_back(edgeErrorClaim(cube->support));
  auto energy = energyClaim(*box, *literal_box, options);
  if (!energy) return energy.status();
  claims.push_back(std::move(*energy));
  progress(0.4);
  claims.push_back(clusterClaim(*cube));
  claims.push_back(laplacianClaim());
  claims.push_back(viscousGrowthClaim(*cube));
  progress(0.5);
  const auto table = measureRates(pool->world, options, [&](double part) { progress(0.5 + 0.4 * part); });
  if (!table) return table.status();
  for (Claim& claim : rateClaims(*table)) claims.push_back(std::move(claim));
  auto shapes = woundClaim(*wounds, options);
  if (!shapes) return shapes.status();
  claims.push_back(std::move(*shapes));
  progress(1.0);

  PaperReport report;
  report.json = {{"experiment", "claims"}, {"threads", options.threads}, {"claims", nlohmann::json::array()}};
  for (const Claim& claim : claims) {
    report.json["claims"].push_back(toJson(claim));
    report.text += toText(claim);
  }
  return report;
}

}  // namespace bleedsim::lab
