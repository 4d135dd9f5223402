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
  int round = 0;  ///< 0 coarse, 1 base, 2 the first value of a knob, 3 its second one
};

/// The knobs that can be asked for.
const std::vector<std::string>& knobNames();

/// Names of the cases that are measured where none are asked for: those whose errors physics.md section 7 names, diffusion of
/// platelets and a film.
const std::vector<std::string>& accuracyCaseNames();

/// By rounds. Of every case the coarsest spacing first, since its cost tells what the others take; then the base of every case;
/// then the first value of every knob, then the second: a short time still holds something of every case and of every knob. Cases
/// without an error figure are left out. Knobs must be among knobNames().
std::vector<Setting> settingsOf(const std::vector<const ValidationCase*>& cases, const std::vector<std::string>& knobs);

/// What a case is expected to take at `knobs`, from `measured` seconds of it at `at`: by the power of the case for spacing, by
/// neighbours for the support radius, by steps for the others.
double estimateSeconds(const ValidationCase& which, const Knobs& at, double measured, const Knobs& knobs);

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
