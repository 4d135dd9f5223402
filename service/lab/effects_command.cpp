// bleedlab effects SCENE: what each effect costs.
#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/app.h"
#include "service/lab/cost_plot.h"
#include "service/lab/progress.h"
#include "service/scene/scene.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::string scene;
  CostOptions options;
  std::string simd = "auto";
  std::string folder;
  bool json = false;
};

/// Why effects.auto left the effect out of the scene; empty if it did not.
std::string leftOut(const scene::SceneDescription& scene, const std::string& effect) {
  const std::string start = "auto: " + effect + " off: ";
  for (const std::string& decision : scene.decisions) {
    if (decision.compare(0, start.size(), start) == 0) return decision.substr(start.size());
  }
  return {};
}

nlohmann::json toJson(const VariantCost& cost) {
  return {{"us_per_particle_step", cost.microseconds.value},
          {"us_scatter", cost.microseconds.scatter},
          {"bytes_per_particle", cost.bytes},
          {"list_bytes_per_particle", cost.list_bytes},
          {"dt_s", cost.dt}};
}

/// `verb`: added or saved; `others`: what the difference's list of effects means.
nlohmann::json toJson(const CostDifference& difference, const std::string& verb, const char* others) {
  nlohmann::json json = toJson(difference.cost);
  json[verb + "_us"] = difference.microseconds.value;
  json[verb + "_us_scatter"] = difference.microseconds.scatter;
  json[verb + "_us_above_noise"] = difference.counts();
  json[verb + "_bytes"] = difference.bytes;
  json[others] = difference.others;
  return json;
}

nlohmann::json toJson(const EffectCosts& costs, const scene::SceneDescription& scene, const Arguments& arguments) {
  nlohmann::json effects = nlohmann::json::array();
  for (const EffectCost& effect : costs.effects) {
    nlohmann::json row{{"name", effect.name}, {"in_scene", effect.in_scene}};
    if (const std::string reason = leftOut(scene, effect.name); !reason.empty()) row["left_out_by_auto"] = reason;
    if (effect.alone) row["alone"] = toJson(*effect.alone, "added", "beside");
    if (effect.without) row["without"] = toJson(*effect.without, "saved", "also_off");
    if (!effect.refusal.empty()) row["refusal"] = effect.refusal;
    effects.push_back(row);
  }
  return {{"scene", arguments.scene},
          {"particles", costs.particles},
          {"threads", arguments.options.threads},
          {"simd", costs.simd},
          {"turns", costs.turns},
          {"steps_per_turn", arguments.options.steps},
          {"clock", costs.cpu_time ? "cpu" : "wall"},
          {"nothing", toJson(costs.nothing)},
          {"all", toJson(costs.scene)},
          {"effects", std::move(effects)}};
}

/// "+0.1234 +-0.0012", or an upper bound where the difference is noise.
std::string shown(const std::optional<CostDifference>& difference) {
  if (!difference) return "-";
  const Measured& us = difference->microseconds;
  if (!difference->counts()) return fmt::format("noise, < {:.4f}", std::abs(us.value) + 2.0 * us.scatter);
  return fmt::format("{:+.4f} +-{:.4f}", us.value, us.scatter);
}

std::string bytesOf(const std::optional<CostDifference>& difference) {
  return difference ? fmt::format("{:+.0f}", difference->bytes) : "-";
}

void printNotes(const EffectCost& effect, const std::string& left_out) {
  if (effect.alone && !effect.alone->others.empty())
    fmt::print("{:<16} on alone beside {}, without which it cannot run\n", "", fmt::join(effect.alone->others, ", "));
  if (effect.without && !effect.without->others.empty())
    fmt::print("{:<16} off together with {}\n", "", fmt::join(effect.without->others, ", "));
  if (!left_out.empty()) fmt::print("{:<16} left out by effects.auto: {}\n", "", left_out);
  if (!effect.refusal.empty()) fmt::print("{:<16} not measured: {}\n", "", effect.refusal);
}

void printTable(const EffectCosts& costs, const scene::SceneDescription& scene, const Arguments& arguments) {
  fmt::print("{} particles, {} thread{}, {}, {} turns of {} steps; {} time\n", costs.particles, arguments.options.threads,
             arguments.options.threads == 1 ? "" : "s", costs.simd, costs.turns, arguments.options.steps,
             costs.cpu_time ? "CPU" : "wall");
  fmt::print(
      "us: microseconds per particle and step, median and median absolute deviation; noise: within twice that\n"
      "B: bytes per particle without neighbour lists\n"
      "on: the effect beside no other, against no effect at all; off: all of the scene less that one\n");
  fmt::print("{:<16} {:>18} {:>18} {:>7} {:>7} {:>8} {:>6}\n", "effect", "on, us", "off, us", "on, B", "off, B", "dt, us",
             "scene");
  for (const EffectCost& effect : costs.effects) {
    const std::string left_out = leftOut(scene, effect.name);
    fmt::print("{:<16} {:>18} {:>18} {:>7} {:>7} {:>8} {:>6}\n", effect.name, shown(effect.alone), shown(effect.without),
               bytesOf(effect.alone), bytesOf(effect.without),
               effect.alone ? fmt::format("{:.1f}", 1e6 * effect.alone->cost.dt) : "-",
               effect.in_scene ? "on" : (left_out.empty() ? "off" : "auto"));
    printNotes(effect, left_out);
  }
  const auto print_set = [](const char* name, const VariantCost& cost) {
    fmt::print("{}: {:.4f} +-{:.4f} us, {:.0f} B and {:.0f} B of lists\n", name, cost.microseconds.value,
               cost.microseconds.scatter, cost.bytes, cost.list_bytes);
  };
  print_set("no effect", costs.nothing);
  print_set("all of the scene", costs.scene);
}

Status drawChart(const EffectCosts& costs, const std::string& folder) {
  picture::BarPlot plot = costPlot(costs, "Cost of each effect", "on alone, against no effect");
  plot.category_label = "effect";
  auto files = picture::writePlot(folder, "effects", plot);
  if (!files) return files.status();
  fmt::print(stderr, "wrote {}\n", files->drawn ? files->png.string() : files->csv.string());
  if (!files->advice.empty()) fmt::print(stderr, "{}\n", files->advice);
  return {};
}

ExitCode run(const Arguments& arguments) {
  auto loaded = scene::loadScene(arguments.scene);
  if (!loaded) return fail(ExitCode::usage, loaded.status().message());
  CostOptions options = arguments.options;
  auto target = sph::parseSimdTarget(arguments.simd);
  if (!target) return fail(ExitCode::usage, target.status().message());
  options.simd = *target;
  Progress progress{"effects"};
  auto costs = measureEffectCosts(loaded->world, options, [&](double part) { progress.report(part); });
  if (!costs) return fail(ExitCode::failed, costs.status().message());
  if (arguments.json)
    fmt::print("{}\n", toJson(*costs, *loaded, arguments).dump(2));
  else
    printTable(*costs, *loaded, arguments);
  if (arguments.folder.empty()) return ExitCode::done;
  std::error_code error;
  std::filesystem::create_directories(arguments.folder, error);
  if (error) return fail(ExitCode::failed, "cannot make folder '" + arguments.folder + "': " + error.message());
  if (Status status = drawChart(*costs, arguments.folder); !status.ok()) return fail(ExitCode::failed, status.message());
  return ExitCode::done;
}

}  // namespace

void addEffectsCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("effects", "Measure what each effect costs: on alone, and off alone");
  command->add_option("scene", arguments->scene, "Scene whose fluid and effects are measured, in a pool")
      ->required()
      ->type_name("SCENE");
  command->add_option("--particles", arguments->options.particles, "Particles of the pool")
      ->capture_default_str()
      ->check(CLI::Range(1000U, 1000000U));
  command->add_option("--threads", arguments->options.threads, "Threads")->capture_default_str()->check(CLI::Range(1, 64));
  command->add_option("--simd", arguments->simd, "auto, scalar, avx2 or avx512")->capture_default_str();
  command->add_option("--seconds", arguments->options.seconds, "Wall time after which no further turn of measurements begins, s")
      ->capture_default_str()
      ->check(finiteIn(0.01, 3600.0));
  command->add_option("-o,--output", arguments->folder, "Also write a table and a bar chart here")->type_name("DIR");
  command->add_flag("--json", arguments->json, "Print JSON")->disable_flag_override();
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
