// bleedlab effects SCENE: what each effect costs.
#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/app.h"
#include "service/lab/effect_costs.h"
#include "service/lab/progress.h"
#include "service/picture/plot.h"
#include "service/scene/scene.h"

namespace bleedsim::lab {
namespace {

struct Arguments {
  std::string scene;
  CostOptions options;
  std::string simd = "auto";
  std::string folder;
  bool json = false;
};

nlohmann::json toJson(const VariantCost& cost) {
  return {{"us_per_particle_step", cost.microseconds},
          {"bytes_per_particle", cost.bytes},
          {"list_bytes_per_particle", cost.list_bytes},
          {"dt_s", cost.dt}};
}

nlohmann::json toJson(const EffectCosts& costs, const Arguments& arguments) {
  nlohmann::json effects = nlohmann::json::array();
  for (const EffectCost& effect : costs.effects) {
    nlohmann::json row{{"name", effect.name}, {"in_scene", effect.in_scene}};
    if (effect.alone) {
      row["alone"] = toJson(*effect.alone);
      row["alone"]["added_us"] = effect.alone->microseconds - costs.base.microseconds;
      row["alone"]["added_bytes"] = effect.alone->bytes - costs.base.bytes;
    }
    if (effect.without) {
      row["without"] = toJson(*effect.without);
      row["without"]["saved_us"] = costs.scene.microseconds - effect.without->microseconds;
      row["without"]["saved_bytes"] = costs.scene.bytes - effect.without->bytes;
    }
    if (!effect.refusal.empty()) row["refusal"] = effect.refusal;
    effects.push_back(row);
  }
  return {{"scene", arguments.scene},     {"particles", costs.particles}, {"threads", arguments.options.threads},
          {"simd", costs.simd},           {"base", toJson(costs.base)},   {"all", toJson(costs.scene)},
          {"effects", std::move(effects)}};
}

void printTable(const EffectCosts& costs, const Arguments& arguments) {
  fmt::print("{} particles, {} thread{}, {}; microseconds per particle and step, bytes per particle without neighbour lists\n",
             costs.particles, arguments.options.threads, arguments.options.threads == 1 ? "" : "s", costs.simd);
  fmt::print("{:<16} {:>9} {:>9} {:>10} {:>10} {:>9} {:>9}\n", "effect", "alone +us", "off -us", "alone +B", "off -B", "dt, us",
             "scene");
  const auto number = [](bool known, double value, int digits) { return known ? fmt::format("{:+.{}f}", value, digits) : "-"; };
  for (const EffectCost& effect : costs.effects) {
    const VariantCost alone = effect.alone.value_or(VariantCost{});
    const VariantCost without = effect.without.value_or(VariantCost{});
    fmt::print("{:<16} {:>9} {:>9} {:>10} {:>10} {:>9} {:>9}\n", effect.name,
               number(effect.alone.has_value(), alone.microseconds - costs.base.microseconds, 4),
               number(effect.without.has_value(), costs.scene.microseconds - without.microseconds, 4),
               number(effect.alone.has_value(), alone.bytes - costs.base.bytes, 0),
               number(effect.without.has_value(), costs.scene.bytes - without.bytes, 0),
               effect.alone ? fmt::format("{:.1f}", 1e6 * alone.dt) : "-", effect.in_scene ? "on" : "off");
    if (!effect.refusal.empty()) fmt::print("{:<16} not measured: {}\n", "", effect.refusal);
  }
  fmt::print(
      "gravity and pressure alone: {:.4f} us, {:.0f} B (+ {:.0f} B of lists); all of the scene: {:.4f} us, {:.0f} B (+ {:.0f} "
      "B)\n",
      costs.base.microseconds, costs.base.bytes, costs.base.list_bytes, costs.scene.microseconds, costs.scene.bytes,
      costs.scene.list_bytes);
}

Status drawChart(const EffectCosts& costs, const std::string& folder) {
  picture::BarPlot plot;
  plot.title = "Cost of each effect";
  plot.category_label = "effect";
  plot.y.label = "microseconds per particle and step";
  picture::BarSeries alone{"on alone, added", {}};
  picture::BarSeries without{"off alone, saved", {}};
  for (const EffectCost& effect : costs.effects) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    plot.categories.push_back(effect.name);
    alone.values.push_back(effect.alone ? effect.alone->microseconds - costs.base.microseconds : kNone);
    without.values.push_back(effect.without ? costs.scene.microseconds - effect.without->microseconds : kNone);
  }
  plot.series = {alone, without};
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
    fmt::print("{}\n", toJson(*costs, arguments).dump(2));
  else
    printTable(*costs, arguments);
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
  command->add_option("--turns", arguments->options.turns, "Measurements, of which the median counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("-o,--output", arguments->folder, "Also write a table and a bar chart here")->type_name("DIR");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
