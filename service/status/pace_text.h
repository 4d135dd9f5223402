// A pace as a person writes it on a command line.
#pragma once

#include <cstdio>
#include <string>

#include "service/status/number_text.h"
#include "service/status/request_limits.h"

namespace bleedsim {

/// "realtime", "max" or a factor, as the pace of whoever asks: an aggregate of `mode` (real_time, factor, maximum) and `factor`.
template <class Pace>
Result<Pace> parsePace(const std::string& text) {
  using Mode = decltype(Pace::mode);
  if (text == "realtime") return Pace{Mode::real_time, 1.0};
  if (text == "max") return Pace{Mode::maximum, 1.0};
  if (checkNumberText(text, kMinPace, kMaxPace)) return Pace{Mode::factor, *parseNumber(text)};
  char range[64];
  std::snprintf(range, sizeof range, "%g to %g", kMinPace, kMaxPace);
  return Status{StatusCode::invalid_argument,
                "pace '" + text + "' is not known: use realtime, max or a factor from " + range + ", as 0.5"};
}

}  // namespace bleedsim
