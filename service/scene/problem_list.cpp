#include "service/scene/problem_list.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace bleedsim::scene {

void ProblemList::add(std::string_view where, std::string_view what) {
  ++count_;
  if (kept_.size() >= kMaxKept) return;
  std::string problem = fmt::format("{}: {}", where, what);
  if (problem.size() > kMaxBytes) {
    std::size_t end = kMaxBytes;
    while (end > 0 && (static_cast<unsigned char>(problem[end]) & 0xC0) == 0x80) --end;  // not inside a UTF-8 character
    problem.resize(end);
    problem += "...";
  }
  kept_.push_back(std::move(problem));
}

void ProblemList::requireInRange(std::string_view path, double value, const Range& range) {
  if (!std::isfinite(value) || (value >= range.lower && value <= range.upper)) return;
  const std::string_view hint = value == 0.0 ? "; 0 also stands for a missing field" : "";
  const std::string unit = range.unit.empty() ? std::string{} : fmt::format(" ({})", range.unit);
  add(path, fmt::format("value {} is out of range, allowed {} to {}{}{}", value, range.lower, range.upper, unit, hint));
}

bool ProblemList::concerns(std::string_view path) const {
  return std::any_of(kept_.begin(), kept_.end(), [path](std::string_view problem) {
    if (!problem.starts_with(path)) return false;
    const char next = problem.size() > path.size() ? problem[path.size()] : ':';
    return next == ':' || next == '.' || next == '[';
  });
}

Status ProblemList::toStatus() const {
  if (empty()) return {};
  std::string message = fmt::format("the scene has {} problem{}:\n{}", count_, count_ == 1 ? "" : "s", fmt::join(kept_, "\n"));
  if (count_ > kept_.size()) message += fmt::format("\n... and {} more", count_ - kept_.size());
  return {StatusCode::invalid_argument, std::move(message)};
}

Status ProblemList::firstToStatus() const {
  if (empty()) return {};
  if (count_ == 1) return {StatusCode::invalid_argument, kept_.front()};
  return {StatusCode::invalid_argument, fmt::format("{} (and {} more)", kept_.front(), count_ - 1)};
}

}  // namespace bleedsim::scene
