#include "service/lab/accuracy/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace bleedsim::lab {
namespace {

constexpr int kCoarse = 10;           // across
constexpr std::array kFiner{28, 14};  // beside the base's 20; the one that separates an error comes first
constexpr double kDoubleCost = 8.0;   // the scalar twin's steps over those of the widest vectors

/// The base with one knob moved, each value of it.
std::vector<Knobs> movedBy(const std::string& knob, const Knobs& base) {
  std::vector<Knobs> moved;
  const auto add = [&](const std::function<void(Knobs&)>& move) {
    Knobs knobs = base;
    move(knobs);
    moved.push_back(knobs);
  };
  if (knob == "spacing") {
    for (const int across : kFiner) add([across](Knobs& knobs) { knobs.across = across; });
  } else if (knob == "support") {
    for (const double ratio : {2.0, 3.0}) add([ratio](Knobs& knobs) { knobs.support_ratio = ratio; });
  } else if (knob == "cfl") {
    for (const double cfl : {0.2, 0.1}) add([cfl](Knobs& knobs) { knobs.cfl = cfl; });
  } else if (knob == "mach") {
    for (const double mach : {20.0, 5.0}) add([mach](Knobs& knobs) { knobs.mach_factor = mach; });
  } else if (knob == "precision") {
    add([](Knobs& knobs) { knobs.precision = sph::Precision::float64; });
  } else if (knob == "threads") {
    add([](Knobs& knobs) { knobs.threads = 2; });
  }
  return moved;
}

}  // namespace

const std::vector<std::string>& knobNames() {
  static const std::vector<std::string> kNames{"spacing", "cfl", "mach", "support", "precision", "threads"};
  return kNames;
}

const std::vector<std::string>& accuracyCaseNames() {
  static const std::vector<std::string> kNames{"inviscid_box", "hydrostatic", "poiseuille",      "couette", "taylor_green",
                                               "drop_period",  "orifice_law", "platelet_spread", "incline"};
  return kNames;
}

std::vector<Setting> settingsOf(const std::vector<const ValidationCase*>& cases, const std::vector<std::string>& knobs) {
  Knobs base;
  base.beside = false;
  Knobs coarse = base;
  coarse.across = kCoarse;
  std::vector<Setting> settings;
  const auto of_every_case = [&](const std::string& knob, const Knobs& at, int round) {
    for (const ValidationCase* one : cases) {
      if (one->measuresAccuracy()) settings.push_back({one, knob, at, round});
    }
  };
  of_every_case("spacing", coarse, 0);
  of_every_case("base", base, 1);
  for (std::size_t value = 0; value < 2; ++value) {
    for (const std::string& knob : knobNames()) {
      if (std::find(knobs.begin(), knobs.end(), knob) == knobs.end()) continue;
      const std::vector<Knobs> moved = movedBy(knob, base);
      if (value < moved.size()) of_every_case(knob, moved[value], 2 + static_cast<int>(value));
    }
  }
  return settings;
}

double estimateSeconds(const ValidationCase& which, const Knobs& at, double measured, const Knobs& knobs) {
  const double finer = static_cast<double>(knobs.across) / at.across;
  double factor = std::pow(finer, which.cost_power) * std::pow(knobs.support_ratio / at.support_ratio, 3.0);
  factor *= std::max(1.0, knobs.mach_factor / at.mach_factor) * (at.cfl / knobs.cfl);
  if (knobs.precision != at.precision) factor *= knobs.precision == sph::Precision::float64 ? kDoubleCost : 1.0 / kDoubleCost;
  return measured * factor;
}

}  // namespace bleedsim::lab
