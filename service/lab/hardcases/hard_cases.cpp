#include <algorithm>

#include "service/lab/hardcases/cases.h"

namespace bleedsim::lab {
namespace {

constexpr std::array kCases{
    HardCase{1, "coincident_particles", "two particles on one spot part, in a direction that is the same every time",
             coincidentParticles},
    HardCase{2, "five_thousand_in_a_cell", "5000 particles in one cell: no neighbour is left out, the slow path is counted",
             fiveThousandInACell},
    HardCase{3, "overlapping_seeds",
             "seeds 0 to 0.3 dx apart, first step 1 ns: they blow apart with the energy of their compression", overlappingSeeds},
    HardCase{4, "bullet", "a bullet at 1 c0 keeps momentum and moves the block; at 5 and 10 c0 it is clamped and survived",
             bullet},
    HardCase{5, "millionfold_force", "a force a million times as large for a frame; calm 0.5 s later", millionfoldForce},
    HardCase{6, "swept_sphere", "a pushing sphere sweeps through a pool at 10 m/s; calm 0.3 s later", sweptSphere},
    HardCase{7, "viscosity_step", "viscosity times 10 000 in one step: kinetic energy never rises", viscosityStep},
    HardCase{8, "checkerboard", "neighbours of 0.004 and 10 Pa s keep momentum to 1e-6", checkerboard},
    HardCase{9, "film_and_filament", "one layer and one thread of particles land and rest", filmAndFilament},
    HardCase{10, "ballistics", "a lone particle and a pair fly exactly ballistically", ballistics},
    HardCase{11, "time_step_requests", "steps of 1 s, 0, -1 s and NaN are bounded or refused", timeStepRequests},
    HardCase{12, "deep_column", "a column of 100 dx starts cold: its top stays within 5 %", deepColumn},
    HardCase{
        13, "cusp_and_gaps",
        "blood in a cusp and over gaps: none into gaps of 0.5 and 1 dx, into 2 dx at most free outflow, none past the tissue",
        cuspAndGaps},
    HardCase{14, "pressure_steps", "inlet pressure between 0 and 120 mmHg: volume = integral of Q to one particle",
             pressureSteps},
    HardCase{15, "leaving_the_domain", "what leaves the domain is removed and counted", leavingTheDomain},
    HardCase{16, "denormals", "denormal numbers slow no stage; flush-to-zero is set on every worker", denormals},
    HardCase{
        17, "weightless_rest",
        "60 s of rest without gravity: drift below 0.01 dx; with all effects under a pressure of 0.5 Pa, adhesion and tension "
        "scaled to the slow sound",
        weightlessRest},
    HardCase{18, "bad_commands", "NaN and Inf in commands are refused and leave no trace", badCommands},
    HardCase{19, "full_to_capacity", "a full world refuses what does not fit, counts it and goes on", fullToCapacity},
    HardCase{20, "same_bits", "threads, pauses and effects that come and go at given steps: bit-equal", sameBits},
};

}  // namespace

std::span<const HardCase> hardCases() { return kCases; }

bool HardOutcome::holds() const {
  const auto all_hold = [](const std::vector<HardFigure>& some) {
    return std::all_of(some.begin(), some.end(), [](const HardFigure& figure) { return figure.holds(); });
  };
  return stopped.empty() && all_hold(figures) && all_hold(always);
}

HardOutcome runHardCase(const HardCase& hard_case, const CaseSetup& setup) {
  CaseRun run{setup};
  hard_case.run(run);
  return std::move(run).finish();
}

}  // namespace bleedsim::lab
