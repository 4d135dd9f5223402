// A sentence of the paper, the numbers that stand for it, and what they say.
//
// One figure is measured with and without the thing that the sentence speaks of, in each model. A difference counts when it is
// above kLeastEffect of the figure and above twice the scatter of both measurements:
//   holds     it counts and has the sign that the paper says
//   does not  it counts and has the other sign, or figures and scatters are equal up to rounding: the thing has no effect at all
//   depends   it does not count
// Over several models: holds where all hold, does not where none does and all count, else depends. A model without figures has no
// voice.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/lab/measured.h"

namespace bleedsim::lab {

inline constexpr double kLeastEffect = 0.05;  ///< smaller differences do not show in a picture

enum class Verdict { holds, does_not, depends };
std::string_view verdictName(Verdict verdict);

/// How the second figure stands to the first, as the paper has it. `equal` is met within kEqualWithin of the first or within the
/// scatter, and never depends.
enum class Direction { larger, smaller, equal };
inline constexpr double kEqualWithin = 0.1;
std::string_view directionName(Direction direction);

Verdict judge(const Measured& with, const Measured& without, Direction claimed);
/// depends for none.
Verdict combine(std::span<const Verdict> verdicts);

/// What one model says of a claim.
struct Evidence {
  std::string model;  ///< or another case, e.g. a kernel
  std::optional<Measured> with;
  std::optional<Measured> without;
  Verdict verdict = Verdict::depends;
  std::string note;  ///< why there is no figure, or what else is to be said
};

struct Claim {
  std::string sentence;
  std::string figure;   ///< name with unit
  std::string with;     ///< what is compared: the first figure, e.g. "(f)"
  std::string without;  ///< and the second
  Direction claimed = Direction::larger;
  std::vector<Evidence> evidence;
  Verdict verdict = Verdict::depends;
};

/// Judges a comparison; not a number or missing on one side: no voice.
Evidence compare(std::string model, const std::optional<Measured>& with, const std::optional<Measured>& without,
                 Direction claimed);
/// Fills in the verdict over all evidence that has figures.
void conclude(Claim& claim);

nlohmann::json toJson(const Claim& claim);
/// Lines for a reader, one a model.
std::string toText(const Claim& claim);

}  // namespace bleedsim::lab
