#include "service/lab/paper/claim.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace bleedsim::lab {
namespace {

bool counts(const Evidence& evidence) { return evidence.with.has_value() && evidence.without.has_value(); }

bool same(double one, double other) { return std::abs(one - other) <= 1e-9 * std::max(std::abs(one), std::abs(other)); }

nlohmann::json toJson(const std::optional<Measured>& measured) {
  if (!measured) return nullptr;
  return {{"value", measured->value}, {"scatter", measured->scatter}};
}

}  // namespace

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::does_not:
      return "does not";
    case Verdict::depends:
      break;
  }
  return "depends";
}

std::string_view directionName(Direction direction) {
  switch (direction) {
    case Direction::larger:
      return "larger";
    case Direction::smaller:
      return "smaller";
    case Direction::equal:
      break;
  }
  return "equal";
}

Verdict judge(const Measured& with, const Measured& without, Direction claimed) {
  const double difference = without.value - with.value;
  const double scatter = 2.0 * std::hypot(with.scatter, without.scatter);
  if (claimed == Direction::equal) {
    const bool met = std::abs(difference) <= std::max(kEqualWithin * std::abs(with.value), scatter);
    return met ? Verdict::holds : Verdict::does_not;
  }
  if (same(with.value, without.value) && same(with.scatter, without.scatter)) return Verdict::does_not;
  const double threshold = std::max(kLeastEffect * std::abs(with.value), scatter);
  if (!(std::abs(difference) > threshold)) return Verdict::depends;
  return (difference > 0.0) == (claimed == Direction::larger) ? Verdict::holds : Verdict::does_not;
}

Verdict combine(std::span<const Verdict> verdicts) {
  if (verdicts.empty()) return Verdict::depends;
  const bool agree = std::all_of(verdicts.begin(), verdicts.end(), [&](Verdict verdict) { return verdict == verdicts.front(); });
  return agree ? verdicts.front() : Verdict::depends;
}

Evidence compare(std::string model, const std::optional<Measured>& with, const std::optional<Measured>& without,
                 Direction claimed) {
  Evidence evidence{.model = std::move(model), .with = with, .without = without, .verdict = Verdict::depends, .note = {}};
  if (with && !std::isfinite(with->value)) evidence.with.reset();
  if (without && !std::isfinite(without->value)) evidence.without.reset();
  if (counts(evidence)) evidence.verdict = judge(*with, *without, claimed);
  return evidence;
}

void conclude(Claim& claim) {
  std::vector<Verdict> verdicts;
  for (const Evidence& evidence : claim.evidence) {
    if (counts(evidence)) verdicts.push_back(evidence.verdict);
  }
  claim.verdict = combine(verdicts);
}

nlohmann::json toJson(const Claim& claim) {
  nlohmann::json evidence = nlohmann::json::array();
  for (const Evidence& one : claim.evidence) {
    nlohmann::json row{{"model", one.model}, {"with", toJson(one.with)}, {"without", toJson(one.without)}};
    row["verdict"] = counts(one) ? nlohmann::json(verdictName(one.verdict)) : nlohmann::json(nullptr);
    if (!one.note.empty()) row["note"] = one.note;
    evidence.push_back(std::move(row));
  }
  return {{"sentence", claim.sentence},
          {"figure", claim.figure},
          {"with", claim.with},
          {"without", claim.without},
          {"claimed", directionName(claim.claimed)},
          {"evidence", std::move(evidence)},
          {"verdict", verdictName(claim.verdict)}};
}

std::string toText(const Claim& claim) {
  std::string text = fmt::format("{}: {}\n", claim.sentence, verdictName(claim.verdict));
  for (const Evidence& one : claim.evidence) {
    if (!counts(one)) {
      text += fmt::format("  {:<8} {}: not measured; {}\n", one.model, claim.figure, one.note);
      continue;
    }
    text += fmt::format("  {:<8} {}: {} {:.4g} +- {:.2g}, {} {:.4g} +- {:.2g}: {}{}\n", one.model, claim.figure, claim.with,
                        one.with->value, one.with->scatter, claim.without, one.without->value, one.without->scatter,
                        verdictName(one.verdict), one.note.empty() ? "" : "; " + one.note);
  }
  return text;
}

}  // namespace bleedsim::lab
