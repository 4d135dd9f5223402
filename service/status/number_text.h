// Numbers that a person writes on a command line.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim {

/// A finite decimal number that fills the whole text; a leading + is allowed.
inline std::optional<double> parseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// ok if the text is a finite number from `lower` to `upper`, both included. Command-line libraries let NaN through their ranges,
/// because it compares with nothing.
inline Status checkNumberText(std::string_view text, double lower, double upper) {
  const std::optional<double> value = parseNumber(text);
  if (value && *value >= lower && *value <= upper) return {};
  char range[64];
  std::snprintf(range, sizeof range, "%g to %g", lower, upper);
  return {StatusCode::invalid_argument, "'" + std::string{text} + "' is not a number from " + range};
}

/// The same as the check of a command-line option: the empty text, or what is wrong.
inline std::function<std::string(const std::string&)> finiteIn(double lower, double upper) {
  return [lower, upper](const std::string& text) { return checkNumberText(text, lower, upper).message(); };
}

}  // namespace bleedsim
