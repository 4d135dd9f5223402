// What every experiment of the paper is told, and what it gives back.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "service/sph/world.h"

namespace bleedsim::lab {

enum class ModelChoice { both, sound, literal };

struct PaperOptions {
  std::string scenes;           ///< folder of the scene files; empty: where they are expected (paper_scene.h)
  std::string folder;           ///< for files, exists; empty: none are written
  std::uint32_t particles = 0;  ///< fig5, fig6, fig8; without --particles those of the scene's horizon_s
  std::vector<std::uint32_t> counts{12000, 15000, 18000, 22000};  ///< table2
  double duration = 0.0;                                          ///< fig2, s; without --duration the scene's horizon_s
  ModelChoice model = ModelChoice::both;
  int threads = 1;
  sph::SimdTarget simd = sph::SimdTarget::automatic;
  double seconds = 8.0;  ///< table2: wall time that the turns of measurements are to take, s

  sph::WorldOptions world() const { return {.threads = threads, .simd = simd}; }
};

/// Told what is done, 0 to 1.
using ProgressReport = std::function<void(double)>;

/// An experiment's result, for a program and for a reader.
struct PaperReport {
  nlohmann::json json = nlohmann::json::object();
  std::string text;
};

}  // namespace bleedsim::lab
