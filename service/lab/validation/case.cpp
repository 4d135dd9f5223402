#include "service/lab/validation/case.h"

#include <algorithm>
#include <cmath>

namespace bleedsim::lab {

std::string_view gradeName(Grade grade) {
  switch (grade) {
    case Grade::holds:
      return "holds";
    case Grade::misses:
      return "misses";
    case Grade::reported:
      break;
  }
  return "reported";
}

Grade Figure::grade() const {
  if (!bound) return Grade::reported;
  return error <= *bound ? Grade::holds : Grade::misses;  // NaN misses
}

Figure compared(std::string name, double value, double reference, std::optional<double> bound, std::string unit) {
  return {std::move(name), value, reference, std::abs(value / reference - 1.0), bound, std::move(unit)};
}

Figure residual(std::string name, double value, std::optional<double> bound) {
  return {std::move(name), value, std::nullopt, std::abs(value), bound, {}};
}

const Figure* CaseResult::find(std::string_view name) const {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& figure) { return figure.name == name; });
  return found == figures.end() ? nullptr : &*found;
}

}  // namespace bleedsim::lab
