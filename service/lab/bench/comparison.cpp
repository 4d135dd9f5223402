#include "service/lab/bench/comparison.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "service/lab/bench/report.h"

namespace bleedsim::lab {
namespace {

// Blood that comes and goes: a scene's count after the same time may differ a little between versions.
constexpr double kSameCount = 0.02;

EarlierCase caseOf(const nlohmann::json& json) {
  EarlierCase one;
  json.at("model").get_to(one.model);
  one.scene = json.value("scene", std::string{});
  json.at("particles").get_to(one.particles);
  json.at("threads").get_to(one.threads);
  json.at("m_updates_per_s").get_to(one.updates);
  json.at("us_per_particle_step").get_to(one.microseconds);
  for (const nlohmann::json& stage : json.at("stages"))
    one.stages.emplace(stage.at("name").get<std::string>(), stage.at("us").get<double>());
  return one;
}

bool isSame(const MeasuredCase& now, const EarlierCase& then) {
  const double off = static_cast<double>(now.particles) - static_cast<double>(then.particles);
  return now.model == then.model && now.scene == then.scene && now.threads == then.threads &&
         std::abs(off) <= kSameCount * now.particles;
}

std::string lineOf(std::string_view name, double now, double then) {
  if (!(now > 0.0) || !(then > 0.0)) return fmt::format("  {:<10} {:>8.4f} {:>8.4f} {:>7}\n", name, now, then, "-");
  return fmt::format("  {:<10} {:>8.4f} {:>8.4f} {:>7.3f}\n", name, now, then, then / now);
}

std::string linesOf(const MeasuredCase& now, const EarlierCase& then) {
  std::string text = fmt::format("\n{}: {:.3f} million particle-updates/s, {:.3f} then: {:.3f} times\n", titleOf(now),
                                 now.updates.median, then.updates, now.updates.median / then.updates);
  text += fmt::format("  {:<10} {:>8} {:>8} {:>7}\n", "stage", "us now", "us then", "times");
  for (std::size_t s = 0; s < now.stages.size(); ++s) {
    const std::string name{sph::stageName(static_cast<sph::Stage>(s))};
    const auto found = then.stages.find(name);
    if (found == then.stages.end())
      text += fmt::format("  {:<10} {:>8.4f} {:>8} {:>7}\n", name, now.stages[s].median, "-", "-");
    else
      text += lineOf(name, now.stages[s].median, found->second);
  }
  return text + lineOf("step", now.microseconds.median, then.microseconds);
}

}  // namespace

Result<EarlierBench> parseBench(const std::string& text, const std::string& name) {
  const auto refused = [&name](const std::string& why) {
    return Status{StatusCode::data_loss, fmt::format("'{}' is not a result of 'bleedlab bench --json': {}", name, why)};
  };
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    EarlierBench bench;
    const nlohmann::json& machine = json.at("machine");
    machine.at("processor").get_to(bench.processor);
    machine.at("cores").get_to(bench.cores);
    machine.at("date").get_to(bench.date);
    json.at("build").get_to(bench.build);
    for (const nlohmann::json& one : json.at("cases")) bench.cases.push_back(caseOf(one));
    if (bench.cases.empty()) return refused("it has no cases");
    for (const EarlierCase& one : bench.cases) {
      if (!(one.updates > 0.0) || !(one.microseconds > 0.0)) return refused("a case without a speed above 0");
    }
    return bench;
  } catch (const nlohmann::json::exception& error) { return refused(error.what()); }
}

Result<EarlierBench> readBench(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return Status{
        StatusCode::not_found,
        fmt::format("'{}' is not a file that can be compared with; give one that 'bleedlab bench --json' wrote", file.string())};
  }
  std::ifstream in{file, std::ios::binary};
  const std::string text{std::istreambuf_iterator<char>{in}, {}};
  if (!in) return Status{StatusCode::io, fmt::format("cannot read '{}'", file.string())};
  return parseBench(text, file.string());
}

std::string comparisonOf(const BenchOutcome& now, const EarlierBench& then, const std::string& name) {
  std::string text = fmt::format("\nagainst {}: {}, {}\n", name, then.build, then.date);
  if (then.processor != now.machine.processor || then.cores != now.machine.cores) {
    text += fmt::format("another machine measured then: {}, {} cores; here {}, {} cores\n", then.processor, then.cores,
                        now.machine.processor, now.machine.cores);
  }
  text += "times: how many times as fast as then, above 1 is faster\n";
  for (const MeasuredCase& one : now.cases) {
    const auto same = [&one](const EarlierCase& earlier) { return isSame(one, earlier); };
    const auto found = std::find_if(then.cases.begin(), then.cases.end(), same);
    text += found == then.cases.end() ? fmt::format("\n{}: not measured then\n", titleOf(one)) : linesOf(one, *found);
  }
  for (const EarlierCase& earlier : then.cases) {
    const auto same = [&earlier](const MeasuredCase& one) { return isSame(one, earlier); };
    if (std::any_of(now.cases.begin(), now.cases.end(), same)) continue;
    text += fmt::format("\n{}, {} particles, {} thread{}: measured then only\n",
                        earlier.scene.empty() ? earlier.model : earlier.scene, earlier.particles, earlier.threads,
                        earlier.threads == 1 ? "" : "s");
  }
  return text;
}

}  // namespace bleedsim::lab
