#include "service/lab/bench/report.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace bleedsim::lab {
namespace {

constexpr const char* kColumns =
    "us: microseconds per particle and step, median (least - most) of the turns; flop and B: per particle and step, by the "
    "equations "
    "and the\narrays of each stage, as service/lab/bench/work_count.h counts them; GFLOP/s and GB/s: those over the time; roof: "
    "part "
    "of what the\nmachine's roofline allows, by the multiply-adds and the triad that were measured beside it, above 100 % where "
    "caches\nfeed a stage; -: not counted\n";

/// GFLOP/s, or GB/s.
double rateOf(double amount, double microseconds) { return microseconds > 0.0 ? 1e-3 * amount / microseconds : 0.0; }

std::string rowOf(std::string_view name, const Sampled& us, const Work& work, const CeilingOutcome& ceiling) {
  const std::string spread = fmt::format("({:.4f} - {:.4f})", us.least, us.most);
  const std::string start = fmt::format("  {:<10} {:>8.4f} {:<19}", name, us.median, spread);
  if (!(work.bytes > 0.0)) return fmt::format("{} {:>7} {:>6} {:>8} {:>6} {:>6}\n", start, "-", "-", "-", "-", "-");
  return fmt::format("{} {:>7.0f} {:>6.0f} {:>8.2f} {:>6.2f} {:>5.1f}%\n", start, work.flops, work.bytes,
                     rateOf(work.flops, us.median), rateOf(work.bytes, us.median),
                     100.0 * rooflineShare(work, us.median, ceiling));
}

/// How many times as fast as the same case on one thread; 0 where that was not measured, or is this one.
double overOneThread(const BenchOutcome& outcome, const MeasuredCase& one) {
  for (const MeasuredCase& other : outcome.cases) {
    const bool same = other.model == one.model && other.scene == one.scene && other.particles == one.particles;
    if (same && one.threads > 1 && other.threads == 1) return one.updates.median / other.updates.median;
  }
  return 0.0;
}

std::string tableOf(const BenchOutcome& outcome, const MeasuredCase& one) {
  const CeilingOutcome& ceiling = outcome.ceilingOf(one.threads);
  const double times = overOneThread(outcome, one);
  const Census& census = one.census;
  std::string text =
      fmt::format("\n{}, {}, dt {:.3g} us{}; {} turns of {} steps\n", titleOf(one), one.simd, 1e6 * one.dt,
                  one.warm_up > 0.0 ? fmt::format(", after {:g} simulated s", one.warm_up) : "", one.turns, one.steps);
  text += fmt::format("  {:.3f} million particle-updates/s ({:.3f} - {:.3f}); {:.1f} neighbours, {:.1f} tested for them\n",
                      one.updates.median, one.updates.least, one.updates.most, census.neighbors, census.candidates);
  if (times > 0.0) text += fmt::format("  {:.2f} times as fast as one thread\n", times);
  text += fmt::format("  {:.0f} B of memory a particle, and {:.0f} B of neighbour lists\n", one.bytes, one.list_bytes);
  text += fmt::format("  {:<10} {:>8} {:<19} {:>7} {:>6} {:>8} {:>6} {:>6}\n", "stage", "us", "", "flop", "B", "GFLOP/s", "GB/s",
                      "roof");
  for (std::size_t s = 0; s < one.stages.size(); ++s)
    text += rowOf(sph::stageName(static_cast<sph::Stage>(s)), one.stages[s], one.work[s], ceiling);
  return text + rowOf("step", one.microseconds, totalOf(one.work), ceiling);
}

/// NAME, NAME_least and NAME_most.
void put(nlohmann::json& json, const std::string& name, const Sampled& value) {
  json[name] = value.median;
  json[name + "_least"] = value.least;
  json[name + "_most"] = value.most;
}

nlohmann::json toJson(const BenchOutcome& outcome, const MeasuredCase& one) {
  const CeilingOutcome& ceiling = outcome.ceilingOf(one.threads);
  nlohmann::json stages = nlohmann::json::array();
  for (std::size_t s = 0; s < one.stages.size(); ++s) {
    nlohmann::json stage{{"name", sph::stageName(static_cast<sph::Stage>(s))}};
    put(stage, "us", one.stages[s]);
    if (one.work[s].bytes > 0.0) {
      stage["flops"] = one.work[s].flops;
      stage["bytes"] = one.work[s].bytes;
      stage["roofline_share"] = rooflineShare(one.work[s], one.stages[s].median, ceiling);
    }
    stages.push_back(std::move(stage));
  }
  const Work total = totalOf(one.work);
  const double us = one.microseconds.median;
  nlohmann::json json{{"model", one.model},
                      {"particles", one.particles},
                      {"threads", one.threads},
                      {"simd", one.simd},
                      {"dt_s", one.dt},
                      {"warm_up_s", one.warm_up},
                      {"turns", one.turns},
                      {"steps_per_turn", one.steps},
                      {"stages", std::move(stages)},
                      {"neighbors", one.census.neighbors},
                      {"list_entries", one.census.listed},
                      {"candidates", one.census.candidates},
                      {"flops_per_particle_step", total.flops},
                      {"bytes_per_particle_step", total.bytes},
                      {"gflops", rateOf(total.flops, us)},
                      {"gb_s", rateOf(total.bytes, us)},
                      {"fma_share", rateOf(total.flops, us) / ceiling.gflops.median},
                      {"triad_share", rateOf(total.bytes, us) / ceiling.gigabytes_s.median},
                      {"roofline_share", rooflineShare(total, us, ceiling)},
                      {"memory_bytes_per_particle", one.bytes},
                      {"list_bytes_per_particle", one.list_bytes}};
  if (const double times = overOneThread(outcome, one); times > 0.0) json["over_one_thread"] = times;
  if (!one.scene.empty()) json["scene"] = one.scene;
  put(json, "m_updates_per_s", one.updates);
  put(json, "us_per_particle_step", one.microseconds);
  return json;
}

}  // namespace

std::string titleOf(const MeasuredCase& outcome) {
  return fmt::format("{}, {} particles, {} thread{}", outcome.scene.empty() ? outcome.model : outcome.scene, outcome.particles,
                     outcome.threads, outcome.threads == 1 ? "" : "s");
}

std::string tablesOf(const BenchOutcome& outcome) {
  std::string text = lineOf(outcome.machine) + "\n" + outcome.build + "\n";
  for (const CeilingOutcome& one : outcome.ceilings) {
    text += fmt::format("{} thread{}: multiply-adds {:.1f} GFLOP/s ({:.1f} - {:.1f}), triad {:.1f} GB/s ({:.1f} - {:.1f})\n",
                        one.threads, one.threads == 1 ? "" : "s", one.gflops.median, one.gflops.least, one.gflops.most,
                        one.gigabytes_s.median, one.gigabytes_s.least, one.gigabytes_s.most);
  }
  text += kColumns;
  for (const MeasuredCase& one : outcome.cases) text += tableOf(outcome, one);
  return text;
}

nlohmann::json toJson(const BenchOutcome& outcome) {
  nlohmann::json ceilings = nlohmann::json::array();
  for (const CeilingOutcome& one : outcome.ceilings) {
    nlohmann::json ceiling{{"threads", one.threads}};
    put(ceiling, "fma_gflops", one.gflops);
    put(ceiling, "triad_gb_s", one.gigabytes_s);
    ceilings.push_back(std::move(ceiling));
  }
  nlohmann::json cases = nlohmann::json::array();
  for (const MeasuredCase& one : outcome.cases) cases.push_back(toJson(outcome, one));
  return {{"experiment", "bench"},
          {"machine", toJson(outcome.machine)},
          {"build", outcome.build},
          {"ceilings", std::move(ceilings)},
          {"cases", std::move(cases)}};
}

}  // namespace bleedsim::lab
