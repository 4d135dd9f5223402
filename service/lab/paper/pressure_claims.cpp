// (16) against (17): cost, edges, energy.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numbers>

#include "service/lab/paper/claims.h"
#include "service/lab/paper/paper_scene.h"

namespace bleedsim::lab {
namespace {

constexpr double kAnyStep = std::numeric_limits<double>::infinity();
constexpr double kHeld = 1e-9;  // s: nothing moves, so that both forms sum over the same pairs

sph::WorldDescription pressureAlone(const sph::WorldDescription& scene, sph::PressureForm form) {
  sph::WorldDescription world = scene;
  world.effects = {};
  world.effects.gravity = scene.effects.gravity;
  world.effects.pressure = scene.effects.pressure ? scene.effects.pressure : sph::PressureSettings{};
  world.effects.pressure->form = form;
  world.literal.pressure = form;
  return world;
}

/// Median with its standard error, by the spread of the samples about it.
Measured medianWithError(const std::vector<double>& values) {
  Measured median = medianOf(values);
  median.scatter *= 1.4826 * std::sqrt(0.5 * std::numbers::pi / static_cast<double>(values.size()));
  return median;
}

/// Relative rms error, within one support radius of the face x = 0 of a half space x > 0 on a lattice of spacing 1, of the
/// acceleration by the pressure p = x with rho0 = 1, whose exact value is -1.
template <class Kernel, class Weight>
std::array<double, 2> edgeErrors(const Kernel& slope, const Weight& weight, double h) {
  const int reach = static_cast<int>(std::ceil(h));
  const auto sum_over = [&](int column, auto&& add) {
    for (int x = std::max(-reach, -column); x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        for (int z = -reach; z <= reach; ++z) {
          const double r = std::sqrt(static_cast<double>(x * x + y * y + z * z));
          if (r < h) add(x, r);
        }
      }
    }
  };
  const int inside = 4 * reach;
  double rest = 0.0;
  sum_over(inside, [&](int, double r) { rest += weight(r); });
  const double mass = 1.0 / rest;
  std::vector<double> density(static_cast<std::size_t>(inside + reach + 1), 0.0);
  for (int column = 0; column <= inside + reach; ++column)
    sum_over(column, [&](int, double r) { density[static_cast<std::size_t>(column)] += mass * weight(r); });
  std::array<double, 2> squares{};
  int columns = 0;
  for (int column = 0; column + 0.5 < h; ++column, ++columns) {
    std::array<double, 2> acceleration{};
    const double p = column + 0.5;
    const double rho = density[static_cast<std::size_t>(column)];
    sum_over(column, [&](int x, double r) {
      if (r == 0.0) return;
      const double other_p = p + x;
      const double other_rho = density[static_cast<std::size_t>(column + x)];
      const double gradient = slope(r) * -x / r;  // of W by the own position, along x
      acceleration[0] -= mass * (p / (rho * rho) + other_p / (other_rho * other_rho)) * gradient;
      acceleration[1] -= mass * (p + other_p) / (2.0 * rho * other_rho) * gradient;
    });
    for (std::size_t k = 0; k < 2; ++k) squares[k] += (acceleration[k] + 1.0) * (acceleration[k] + 1.0);
  }
  return {std::sqrt(squares[0] / columns), std::sqrt(squares[1] / columns)};
}

/// Kinetic and internal energy per mass, J/kg, of either model; p = p0 + k (rho - rho0) gives e = p0 (1/rho0 - 1/rho) + k
/// (ln(rho/rho0) + rho0/rho
/// - 1).
struct Energies {
  double kinetic = 0.0, whole = 0.0;
};
Energies energiesOf(const sph::World& world, sph::FrameBuffer& frame) {
  world.copyFrame(frame, sph::kFrameVelocity | sph::kFrameDensity);
  const double rho0 = world.description().rest_density;
  const double p0 = world.description().effects.pressure->background_pressure;
  const double k = world.speedOfSound() * world.speedOfSound();  // of (19) too
  Energies energies;
  for (std::size_t i = 0; i < frame.count; ++i) {
    double speed2 = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double v = static_cast<double>(frame.velocity[3 * i + a]);
      speed2 += v * v;
    }
    const double ratio = static_cast<double>(frame.density[i]) / rho0;
    energies.kinetic += 0.5 * speed2;
    energies.whole += 0.5 * speed2 + p0 / rho0 * (1.0 - 1.0 / ratio) + k * (std::log(ratio) + 1.0 / ratio - 1.0);
  }
  energies.kinetic /= frame.count;
  energies.whole /= frame.count;
  return energies;
}

/// What an inviscid box has become.
struct EnergyGrowth {
  double drift = 0.0;    ///< |E - E0| over the kinetic energy at the start
  double kinetic = 0.0;  ///< K/K0
  double whole = 0.0;    ///< E/E0
};

Result<EnergyGrowth> energyGrowth(const sph::WorldDescription& box, sph::PressureForm form, double seconds,
                                  const PaperOptions& options) {
  auto world = sph::createWorld(pressureAlone(box, form), options.world());
  if (!world) return world.status();
  sph::FrameBuffer frame;
  frame.reserve(box.capacity, sph::kFrameVelocity | sph::kFrameDensity);
  const Energies start = energiesOf(**world, frame);
  while ((*world)->time() < seconds) {
    if (Status status = (*world)->step(kAnyStep); !status.ok()) return status;
  }
  const Energies end = energiesOf(**world, frame);
  return EnergyGrowth{.drift = std::abs(end.whole - start.whole) / start.kinetic,
                      .kinetic = end.kinetic / start.kinetic,
                      .whole = end.whole / start.whole};
}

Result<Evidence> energyEvidence(const std::string& model, const scene::SceneDescription& box, const PaperOptions& options) {
  const auto seconds = horizonOf(box);
  if (!seconds) return seconds.status();
  const auto symmetric = energyGrowth(box.world, sph::PressureForm::symmetric, *seconds, options);
  if (!symmetric) return symmetric.status();
  const auto variational = energyGrowth(box.world, sph::PressureForm::variational, *seconds, options);
  if (!variational) return variational.status();
  Evidence evidence = compare(model, Measured{symmetric->drift, 0.0}, Measured{variational->drift, 0.0}, Direction::larger);
  evidence.note = fmt::format("kinetic energy x{:.3g} with (17), x{:.3g} with (16); whole x{:.3g}, x{:.3g}; after {:.3g} s",
                              symmetric->kinetic, variational->kinetic, symmetric->whole, variational->whole, *seconds);
  return evidence;
}

}  // namespace

Result<Claim> pressureCostClaim(const sph::WorldDescription& pool, const PaperOptions& options) {
  using Clock = std::chrono::steady_clock;
  constexpr std::array kForms{sph::PressureForm::symmetric, sph::PressureForm::variational};
  std::array<std::unique_ptr<sph::World>, 2> worlds;
  std::array<std::vector<double>, 2> seconds;
  for (std::size_t k = 0; k < 2; ++k) {
    auto world = sph::createWorld(pressureAlone(pool, kForms[k]), options.world());
    if (!world) return world.status();
    worlds[k] = std::move(*world);
  }
  constexpr int kTurns = 41;  // enough for a standard error of a median well below the threshold on a busy machine
  constexpr int kSteps = 5;   // in a turn, so that what slows the machine for longer slows both forms
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::size_t k = 0; k < 2; ++k) {
      const Clock::time_point start = Clock::now();
      for (int step = 0; step < kSteps; ++step) {
        if (Status status = worlds[k]->step(kHeld); !status.ok()) return status;
      }
      const double spent = std::chrono::duration<double>(Clock::now() - start).count();
      seconds[k].push_back(1e6 * spent / kSteps / worlds[k]->particleCount());
    }
  }
  Claim claim{.sentence = "(16) costs more than (17)",
              .figure = "us per particle and step",
              .with = "(17)",
              .without = "(16)",
              .claimed = Direction::larger,
              .evidence = {compare("sound", medianWithError(seconds[0]), medianWithError(seconds[1]), Direction::larger)},
              .verdict = Verdict::depends};
  claim.evidence.front().note = fmt::format("medians of {} turns of {} steps, particles held", kTurns, kSteps);
  conclude(claim);
  return claim;
}

Claim edgeErrorClaim(double support) {
  Claim claim{.sentence = "(17) is more accurate at edges",
              .figure = "rms error of the acceleration within h of a face",
              .with = "(17)",
              .without = "(16)",
              .claimed = Direction::larger,
              .evidence = {},
              .verdict = Verdict::depends};
  const auto add = [&](const char* name, const std::array<double, 2>& errors) {
    claim.evidence.push_back(compare(name, Measured{errors[1], 0.0}, Measured{errors[0], 0.0}, Direction::larger));
    claim.evidence.back().note = fmt::format("half a space on a cubic lattice, h = {:g} dx, p linear", support);
  };
  const sph::SmoothingKernel wendland{sph::KernelType::wendland_c2, support, 0.0};
  add("Wendland", edgeErrors([&](double r) { return wendland.slope(r); }, [&](double r) { return wendland.value(r); }, support));
  const sph::SmoothingKernel spiky{sph::KernelType::spiky, support, 0.0};
  const sph::SmoothingKernel poly6{sph::KernelType::poly6, support, 0.0};
  add("paper's", edgeErrors([&](double r) { return spiky.slope(r); }, [&](double r) { return poly6.value(r); }, support));
  conclude(claim);
  return claim;
}

Result<Claim> energyClaim(const scene::SceneDescription& box, const scene::SceneDescription& literal_box,
                          const PaperOptions& options) {
  auto sound = energyEvidence("sound", box, options);
  if (!sound) return sound.status();
  auto literal = energyEvidence("literal", literal_box, options);
  if (!literal) return literal.status();
  Claim claim{.sentence = "(17) is more accurate: it keeps energy better",
              .figure = "|E - E0|/K0 of an inviscid periodic box",
              .with = "(17)",
              .without = "(16)",
              .claimed = Direction::larger,
              .evidence = {std::move(*sound), std::move(*literal)},
              .verdict = Verdict::depends};
  conclude(claim);
  return claim;
}

}  // namespace bleedsim::lab
