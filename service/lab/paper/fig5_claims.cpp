// The sentences of paper.md about Fig. 5, each with the figures that stand for its words.
#include <algorithm>

#include "service/lab/paper/fig5.h"

namespace bleedsim::lab {
namespace {

struct Sentence {
  char letter;  ///< compared with (f)
  const char* words;
  GushFigure figure;
  Direction claimed;  ///< of the run without
};
constexpr std::array kSentences{
    Sentence{'a', "(a) classical: its surface is not smooth", GushFigure::roughness, Direction::larger},
    Sentence{'a', "(a) classical: its edge is not smooth", GushFigure::serration, Direction::larger},
    Sentence{'b', "(b) no tension: the blood diffuses", GushFigure::area, Direction::larger},
    Sentence{'b', "(b) no tension: the blood diffuses into lone particles", GushFigure::alone, Direction::larger},
    Sentence{'b', "(b) no tension: the surface is not rounded", GushFigure::sphericity, Direction::smaller},
    Sentence{'c', "(c) no platelets: the surface is unsmooth", GushFigure::roughness, Direction::larger},
    Sentence{'c', "(c) no platelets: the blood is discrete, in pieces", GushFigure::pieces, Direction::larger},
    Sentence{'c', "(c) no platelets: the blood is discrete, lone particles", GushFigure::alone, Direction::larger},
    Sentence{'d', "(d) no repulsion: the gush narrows at the source", GushFigure::gush_width, Direction::smaller},
    Sentence{'d', "(d) no repulsion: particles around the source sink", GushFigure::height_at_source, Direction::smaller},
    Sentence{'d', "(d) no repulsion: particles sink into each other", GushFigure::nearest_percentile, Direction::smaller},
    Sentence{'d', "(d) no repulsion: the blood looks thinner", GushFigure::mean_height, Direction::smaller},
    Sentence{'e', "(e) constant h: the edge is serrated", GushFigure::serration, Direction::larger},
    Sentence{'e', "(e) constant h: the surface is rough", GushFigure::roughness, Direction::larger},
};

const Fig5Run* findRun(const std::vector<Fig5Run>& runs, const std::string& model, char letter) {
  const auto found =
      std::find_if(runs.begin(), runs.end(), [&](const Fig5Run& run) { return run.model == model && run.letter == letter; });
  return found == runs.end() ? nullptr : &*found;
}

Measured scaled(const Measured& measured, double scale) { return {scale * measured.value, scale * measured.scatter}; }

std::optional<Measured> figureOf(const Fig5Run& run, GushFigure figure) {
  const auto measured = run.figure(figure);
  if (!measured) return std::nullopt;
  return scaled(*measured, infoOf(figure).scale);
}

/// Whether the run's platelets are there and do nothing.
bool hasIdlePlatelets(const Fig5Run& run) {
  return run.failure.empty() && run.platelet_change && *run.platelet_change < kUniformPlatelets;
}

/// (f) all on: smooth. Its roughness beside that of the smoothest other run.
Claim judgeSmoothest(const std::vector<Fig5Run>& runs, const std::vector<std::string>& models) {
  Claim claim{.sentence = "(f) all improvements: the smoothest surface of all",
              .figure = std::string{infoOf(GushFigure::roughness).title},
              .with = "(f)",
              .without = "smoothest other",
              .claimed = Direction::larger,
              .evidence = {},
              .verdict = Verdict::depends};
  for (const std::string& model : models) {
    const Fig5Run* all = findRun(runs, model, 'f');
    const bool same_as_c = all != nullptr && hasIdlePlatelets(*all);
    std::optional<Measured> best;
    char letter = ' ';
    for (const Fig5Run& run : runs) {
      if (run.model != model || run.letter == 'f' || (run.letter == 'c' && same_as_c)) continue;
      const auto other = figureOf(run, GushFigure::roughness);
      if (!other || (best && best->value <= other->value)) continue;
      best = other;
      letter = run.letter;
    }
    Evidence evidence =
        compare(model, all != nullptr ? figureOf(*all, GushFigure::roughness) : std::nullopt, best, Direction::larger);
    evidence.note = best ? std::string{"the smoothest other run is ("} + letter + ")" : "no other run has figures";
    if (same_as_c) evidence.note += "; (c) is (f) but for chance, P being uniform";
    claim.evidence.push_back(std::move(evidence));
  }
  conclude(claim);
  return claim;
}

}  // namespace

std::vector<Claim> judgeFig5(const std::vector<Fig5Run>& runs) {
  std::vector<std::string> models;
  for (const Fig5Run& run : runs) {
    if (std::find(models.begin(), models.end(), run.model) == models.end()) models.push_back(run.model);
  }
  std::vector<Claim> claims;
  for (const Sentence& sentence : kSentences) {
    Claim claim{.sentence = sentence.words,
                .figure = std::string{infoOf(sentence.figure).title},
                .with = "(f)",
                .without = std::string{"("} + sentence.letter + ")",
                .claimed = sentence.claimed,
                .evidence = {},
                .verdict = Verdict::depends};
    for (const std::string& model : models) {
      const Fig5Run* with = findRun(runs, model, 'f');
      const Fig5Run* without = findRun(runs, model, sentence.letter);
      if (with == nullptr || without == nullptr) continue;
      Evidence evidence = compare(model, figureOf(*with, sentence.figure), figureOf(*without, sentence.figure), sentence.claimed);
      evidence.note = !with->failure.empty() ? with->failure : without->failure;
      if (sentence.letter == 'c' && hasIdlePlatelets(*with)) {
        evidence.verdict = Verdict::does_not;
        evidence.note =
            "no effect: P is uniform, so mu is one constant, blood's, with platelets and without; what differs is chance";
      }
      claim.evidence.push_back(std::move(evidence));
    }
    conclude(claim);
    claims.push_back(std::move(claim));
  }
  claims.push_back(judgeSmoothest(runs, models));
  return claims;
}

}  // namespace bleedsim::lab
