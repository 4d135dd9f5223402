// Which settings of which cases work-precision is measured at: the knobs of physics.md section 7, one moved at a time.
#pragma once

#include <string>
#include <vector>

#include "service/lab/validation/case.h"

namespace bleedsim::lab {

struct Setting {
  const ValidationCase* which = nullptr;
  std::string knob;  ///< that is moved: "spacing", "support", "cfl", "mach", "precision", "threads"; "base" for none
  Knobs knobs;
};

/// The knobs that can be asked for.
const std::vector<std::string>& knobNames();

/// Of every case the coarsest spacing first, since its cost tells what the others take; then the base of every case; then, knob
/// by knob, the rest. Cases without an error figure are left out. Knobs must be among knobNames().
std::vector<Setting> settingsOf(const std::vector<const ValidationCase*>& cases, const std::vector<std::string>& knobs);

/// What `setting` is expected to take, from `measured` seconds of the same case at `at`: particles and steps in three dimensions
/// for spacing, neighbours for the support radius, steps for the others. An upper estimate where the sides of a case shrink with
/// its spacing or its steps are not bounded by sound.
double estimateSeconds(const Knobs& at, double measured, const Knobs& setting);

/// A wall time that is kept: what does not fit is not begun.
class TimeBudget {
 public:
  explicit TimeBudget(double seconds) : left_{seconds} {}
  bool fits(double seconds) const { return seconds <= left_; }
  void spend(double seconds) { left_ -= seconds; }
  double left() const { return left_; }

 private:
  double left_;
};

}  // namespace bleedsim::lab
