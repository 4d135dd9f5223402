#include <algorithm>
#include <array>

#include "service/lab/validation/cases.h"

namespace bleedsim::lab {
namespace {

constexpr std::array kCases{
    ValidationCase{"interpolation", 1, "kernel moments, slopes, order of interpolation on a lattice",
                   "integral W = 1; dW/dr <= 0; error ~ h^2", "", 0.0, runInterpolation},
    ValidationCase{"free_fall", 2, "a block in free fall", "z = g t^2/2", "", 0.0, runFreeFall},
    ValidationCase{"spinning_blob", 2, "momentum of colliding blocks, angular momentum of a turning one", "both are kept", "",
                   0.0, runSpinningBlob},
    ValidationCase{"inviscid_box", 3, "energy of an inviscid swirl by t = 200 dx/c0", "it is kept", "periodic_energy", 3.0,
                   runInviscidBox},
    ValidationCase{"hydrostatic", 4, "pressure of a column at rest", "dp/dz = -rho g", "pressure_slope", 2.0, runHydrostatic},
    ValidationCase{"poiseuille", 5, "start of a flow between planes", "series of Morris, Fox & Zhu 1997", "l2_steady", 3.0,
                   runPoiseuille},
    ValidationCase{"couette", 6, "start of a flow under a moving plane", "series of Morris, Fox & Zhu 1997", "l2_at_0_1125_s",
                   3.0, runCouette},
    ValidationCase{"layers", 6, "two layers of unlike blood: profile and stress between them", "continuous stress", "profile_l2",
                   3.0, runLayers},
    ValidationCase{"casson", 7, "plane flow of Casson blood", "closed form, physics.md 5.7", "l2", 3.0, runCasson},
    ValidationCase{"carreau", 7, "plane flow of Carreau blood", "mu(g) g = G y, integrated", "l2", 3.0, runCarreau},
    ValidationCase{"taylor_green", 8, "decay of Taylor-Green vortices, Re = 100", "KE/KE0 = exp(-16 pi^2 nu t/L^2)", "decay_rate",
                   3.0, runTaylorGreen},
    ValidationCase{"drop_period", 9, "oscillation of a free drop", "omega^2 = 8 sigma/(rho R^3), Rayleigh 1879", "period", 4.0,
                   runDropPeriod},
    ValidationCase{"drop_pressure", 9, "pressure in a free drop", "p = 2 sigma/R, Laplace", "core_pressure", 3.0,
                   runDropPressure},
    ValidationCase{"dam_break", 10, "front of a collapsing column", "Martin & Moyce 1952, n^2 = 2, digitised, second-hand", "",
                   3.0, runDamBreak},
    ValidationCase{"orifice_law", 11, "flow of pressure-driven wounds", "Q = Cd A sqrt(2 dp/rho)", "", 0.0, runOrificeLaw},
    ValidationCase{"orifice_resolved", 11, "discharge through a slot in a tank's floor", "Q = Cd A sqrt(2 g H), Cd .61-.97", "",
                   3.0, runOrificeResolved},
    ValidationCase{"platelet_spread", 12, "diffusion of a step", "P = erfc(x/(2 sqrt(k t)))/2", "l2", 3.0, runPlateletSpread},
    ValidationCase{"platelet_activation", 12, "clotting at rest", "t50 = ln 99/r", "", 0.0, runPlateletActivation},
    ValidationCase{"incline", 13, "film on a slope of 30 degrees", "u = rho g sin(30) H^2/(2 mu)", "profile_l2", 2.0, runIncline},
    ValidationCase{"standing_wave", 14, "period of a standing wave", "omega^2 = g k tanh(k d)", "period", 3.0, runStandingWave},
    ValidationCase{"puddle", 14, "height of a wide puddle", "2 l_c sin(theta/2)", "", 3.5, runPuddle},
    ValidationCase{"square_patch", 14, "angular momentum of a turning square", "it is kept", "", 3.0, runSquarePatch},
    ValidationCase{"contact_angle", 0, "cap of a sessile drop without gravity", "mean height of the cap at the angle", "", 4.0,
                   runContactAngle},
    ValidationCase{"thick_blood", 0, "plane flow by the implicit solve, far beyond the explicit limit",
                   "u = rho F z (L - z)/(2 mu)", "l2", 2.0, runThickBlood},
};

}  // namespace

std::span<const ValidationCase> validationCases() { return kCases; }

const ValidationCase* findCase(std::string_view name) {
  const auto* found = std::find_if(kCases.begin(), kCases.end(), [&](const ValidationCase& one) { return one.name == name; });
  return found == kCases.end() ? nullptr : found;
}

}  // namespace bleedsim::lab
