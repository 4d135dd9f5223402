// Fig. 5 of the paper: blood from a round wound, each improvement switched off in turn, and what is lost by it.
//
// Every run is sampled kSamples times while its last tenth comes; a figure is the mean of the samples, its scatter their standard
// deviation about the trend.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "service/lab/footprint.h"
#include "service/lab/paper/claim.h"
#include "service/lab/paper/gush_figures.h"
#include "service/lab/paper/paper_options.h"
#include "service/sph/effect_settings.h"
#include "service/status/status.h"

namespace bleedsim::lab {

inline constexpr int kSamples = 5;

/// Changes mu = b exp(-a P) by less than 1 % for every a that gives blood its viscosity.
inline constexpr double kUniformPlatelets = 1e-3;

/// (a) to (f): which of the four improvements are left.
struct Fig5Variant {
  char letter;
  const char* title;
  bool tension, platelets, radius, repulsion;
};
inline constexpr std::array kFig5Variants{
    Fig5Variant{'a', "classical", false, false, false, false},
    Fig5Variant{'b', "no tension", false, true, true, true},
    Fig5Variant{'c', "no platelets", true, false, true, true},
    Fig5Variant{'d', "no repulsion", true, true, true, false},
    Fig5Variant{'e', "constant core radius", true, true, false, true},
    Fig5Variant{'f', "all improvements", true, true, true, true},
};

/// The scene's effects without those that the variant lacks.
sph::EffectSettings effectsOf(const sph::EffectSettings& scene, const Fig5Variant& variant);

struct Fig5Run {
  std::string model;
  char letter = 'f';
  std::string failure;  ///< why there are no figures
  std::uint32_t emitted = 0;
  std::uint32_t lost = 0;  ///< left the domain
  double time = 0.0;       ///< simulated, s
  std::array<Measured, static_cast<std::size_t>(GushFigure::count)> figures{};
  /// How far a particle's P came from that of fresh blood, at most; nothing without platelets. Below kUniformPlatelets the
  /// viscosity of (26) is one constant, and the run differs from one without platelets by rounding alone.
  std::optional<double> platelet_change;
  HeightProfile profile;
  std::vector<float> positions;  ///< at the end

  std::optional<Measured> figure(GushFigure figure) const {
    return failure.empty() ? std::optional{figures[static_cast<std::size_t>(figure)]} : std::nullopt;
  }
};

/// The sentences of Fig. 5, judged by runs of one model or two.
std::vector<Claim> judgeFig5(const std::vector<Fig5Run>& runs);

/// Runs of the models that the options ask for, as many at a time as there are threads.
Result<std::vector<Fig5Run>> runFig5Variants(const PaperOptions& options, const ProgressReport& progress);

Result<PaperReport> runFig5(const PaperOptions& options, const ProgressReport& progress);

}  // namespace bleedsim::lab
