// bleedlab choose: the resolution that fits a budget on this machine, written as a scene and measured.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/app.h"
#include "service/lab/choose/chooser.h"
#include "service/lab/json_option.h"
#include "service/lab/lab_files.h"
#include "service/lab/machine.h"
#include "service/lab/progress.h"
#include "service/scene/change_resolution.h"
#include "service/scene/feature_size.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

constexpr double kDefaultHorizon = 5.0;     // s
constexpr double kCoarseParticles = 300.0;  // at the horizon, of the two runs of a calibration
constexpr double kFineParticles = 1000.0;
constexpr double kTensionSupport = 2.5;  // below it drops boil
constexpr double kTrusted = 0.2;         // part of the predicted time by which the measured one may differ
// What a scene can do without; gravity, pressure, viscosity and the forces of instruments it cannot.
constexpr std::array kOptional{"core_radius", "repulsion", "adhesion", "platelets", "surface_tension"};

struct Arguments {
  std::string scene;
  double budget_ms = 16.0;
  std::optional<double> error;
  std::optional<double> horizon;
  std::optional<double> feature_mm;
  std::string results;
  int threads = 1;
  std::string output;
  std::string json;
};

/// The narrowest wound or the shortest side of a block, m.
double featureOf(const sph::WorldDescription& world) {
  double feature = std::numeric_limits<double>::infinity();
  for (const sph::WoundDescription& wound : world.wounds) feature = std::min(feature, scene::patchWidth(wound.shape));
  for (const sph::FluidBlock& block : world.fluid_blocks) feature = std::min(feature, (block.upper - block.lower).minCoeff());
  return feature;
}

struct Calibration {
  std::map<double, TimeModel> time;      ///< by support ratio
  std::map<double, double> compression;  ///< k of k/mach^2
};

class Chooser {
 public:
  Chooser(scene::SceneDescription scene, const Arguments& arguments)
      : scene_{std::move(scene)},
        arguments_{arguments},
        horizon_{arguments.horizon.value_or(scene_.horizon.value_or(kDefaultHorizon))},
        feature_{arguments.feature_mm ? 1e-3 * *arguments.feature_mm : featureOf(scene_.world)},
        options_{.threads = arguments.threads} {}

  Status check() const {
    if (scene_.world.model == sph::Model::literal)
      return {StatusCode::invalid_argument, "the literal model has no accuracy to choose by; use a scene of model SOUND"};
    if (!std::isfinite(feature_))
      return {StatusCode::invalid_argument,
              "the scene has neither a wound nor a block of blood; say what must be resolved with "
              "--feature-mm"};
    if (!(volumeOf(scene_.world, horizon_) > 0.0))
      return {StatusCode::invalid_argument, "nothing bleeds within the horizon; give a longer --horizon or a scene with blood"};
    return {};
  }

  /// All effects of the scene first, then only those that it cannot do without.
  Status decide() {
    if (Status status = measureErrors(); !status.ok()) return status;
    Status all = tryWith({});
    if (all.ok() || all.code() != StatusCode::capacity) return all;
    std::vector<std::string> optional;
    for (const char* name : kOptional) {
      if (std::find(scene_.effects.begin(), scene_.effects.end(), name) != scene_.effects.end()) optional.emplace_back(name);
    }
    if (optional.empty()) return all;
    if (Status reduced = tryWith(optional); reduced.ok() || reduced.code() != StatusCode::capacity) return reduced;
    return {all.code(), all.message() + fmt::format("; it does not fit without {} either", fmt::join(optional, ", "))};
  }

  /// Runs what was chosen.
  Status measure() {
    auto sample = runScene(chosen_->world, horizon_, chosen_->frame_rate, options_);
    if (!sample) return sample.status();
    measured_ = std::move(*sample);
    rows_ = std::max(2, static_cast<int>(std::lround(feature_ / choice_.spacing)));
    const auto flow = measureFlow(choice_.support_ratio, rows_, options_);
    if (!flow) return flow.status();
    flow_error_ = flow->error;
    return {};
  }

  const std::string& text() const { return chosen_->normalized_text; }
  void print() const;
  /// Measured over predicted.
  double timeRatio() const { return measured_.frame_ms / choice_.time.milliseconds; }
  nlohmann::json toJson() const;

 private:
  Status measureErrors() {
    if (!arguments_.results.empty()) {
      auto points = readFlowPoints(arguments_.results);
      if (!points) return points.status();
      flow_points_ = std::move(*points);
      return {};
    }
    for (const double support : supports(scene_.world)) {
      for (const int rows : {3, 5, 8}) {
        const auto point = measureFlow(support, rows, options_);
        if (!point) return point.status();
        flow_points_.push_back(*point);
      }
    }
    return {};
  }

  static std::vector<double> supports(const sph::WorldDescription& world) {
    std::vector<double> ratios;
    for (const double ratio : {2.0, 2.5, 3.0}) {
      if (ratio >= kTensionSupport || !world.effects.surface_tension) ratios.push_back(ratio);
    }
    return ratios;
  }

  /// The scene at the spacing that gives so many particles at the horizon.
  Result<SceneSample> calibrate(double particles, double support, const std::vector<std::string>& left_out) const {
    scene::ResolutionChange change;
    change.spacing = std::min(0.02, std::cbrt(volumeOf(scene_.world, horizon_) / particles));
    change.support_ratio = support;
    change.mach_factor = scene_.world.compressibility.mach_factor;
    change.capacity = static_cast<std::uint32_t>(2.0 * particles);
    change.left_out = left_out;
    const auto coarse = scene::changeResolution(scene_, change);
    if (!coarse) return Status{StatusCode::invalid_argument, "cannot be calibrated coarsely: " + coarse.status().message()};
    return runScene(coarse->world, horizon_, scene_.frame_rate, options_);
  }

  Status tryWith(const std::vector<std::string>& left_out) {
    Calibration calibration;
    sph::WorldDescription world = scene_.world;
    if (std::find(left_out.begin(), left_out.end(), "surface_tension") != left_out.end()) world.effects.surface_tension.reset();
    for (const double support : supports(world)) {
      auto coarse = calibrate(kCoarseParticles, support, left_out);
      if (!coarse) return coarse.status();
      auto fine = calibrate(kFineParticles, support, left_out);
      if (!fine) return fine.status();
      const double mach = scene_.world.compressibility.mach_factor;
      calibration.compression[support] = fine->density_error * mach * mach;
      calibration.time.emplace(support, TimeModel{std::move(*coarse), std::move(*fine)});
    }
    const ErrorModel errors{flow_points_, calibration.compression};
    ChoiceModels models;
    for (const auto& [support, model] : calibration.time) {
      if (errors.knows(support)) models.support_ratios.push_back(support);
    }
    if (models.support_ratios.empty())
      return {StatusCode::invalid_argument, "the results hold too few rows of the case incline for any h/dx of this scene"};
    models.time = [&](double support, double spacing, double mach) {
      return calibration.time.at(support).predict(spacing, mach, scene_.frame_rate);
    };
    models.error = [&](double support, double spacing, double mach) { return errors.predict(support, feature_ / spacing, mach); };
    const auto choice = choose(models, {arguments_.budget_ms, arguments_.error, feature_});
    if (!choice) return choice.status();
    scene::ResolutionChange change;
    change.spacing = choice->spacing;
    change.support_ratio = choice->support_ratio;
    change.mach_factor = choice->mach_factor;
    change.capacity = static_cast<std::uint32_t>(1.25 * choice->time.particles) + 100U;
    change.left_out = left_out;
    auto chosen = scene::changeResolution(scene_, change);
    if (!chosen) return {StatusCode::invalid_argument, "the choice is no valid scene: " + chosen.status().message()};
    choice_ = *choice;
    chosen_ = std::move(*chosen);
    left_out_ = left_out;
    at_rows_ = errors.predict(choice->support_ratio, std::max(2.0, std::round(feature_ / choice->spacing)), choice->mach_factor);
    return {};
  }

  scene::SceneDescription scene_;
  const Arguments& arguments_;
  double horizon_;
  double feature_;
  sph::WorldOptions options_;
  std::vector<FlowPoint> flow_points_;
  std::optional<scene::SceneDescription> chosen_;
  Choice choice_;
  PredictedError at_rows_;  ///< where the flow's error is measured: at whole rows
  std::vector<std::string> left_out_;
  SceneSample measured_;
  int rows_ = 0;
  double flow_error_ = 0.0;
};

void Chooser::print() const {
  fmt::print("{}\n", lineOf(thisMachine()));
  fmt::print("chosen: dx = {:.3f} mm, h = {} dx, Mach factor {}, {} thread{}, effects: {}\n", 1e3 * choice_.spacing,
             choice_.support_ratio, choice_.mach_factor, arguments_.threads, arguments_.threads == 1 ? "" : "s",
             fmt::join(chosen_->effects, ", "));
  if (!left_out_.empty()) fmt::print("left out, since nothing fits with them: {}\n", fmt::join(left_out_, ", "));
  fmt::print("{:<38} {:>12} {:>12}\n", "", "predicted", "measured");
  const auto row = [](const char* name, double predicted, double measured, const char* unit) {
    fmt::print("{:<38} {:>12.4g} {:>12.4g} {}\n", name, predicted, measured, unit);
  };
  row("a frame at the horizon", choice_.time.milliseconds, measured_.frame_ms, arguments_.threads == 1 ? "ms of CPU time" : "ms");
  fmt::print("{:<38} {:>25.3f}\n", "  measured over predicted", timeRatio());
  row("particles", choice_.time.particles, measured_.particles, "");
  row("steps in a frame", choice_.time.steps, 1.0 / (measured_.dt * chosen_->frame_rate), "");
  row("time per particle and step", choice_.time.microseconds, measured_.microseconds, "us");
  row(fmt::format("error of a film of {} rows", rows_).c_str(), 100.0 * at_rows_.flow, 100.0 * flow_error_, "%");
  row("largest compression", 100.0 * choice_.error.compression, 100.0 * measured_.density_error, "%");
}

nlohmann::json Chooser::toJson() const {
  return {{"machine", lab::toJson(thisMachine())},
          {"scene", arguments_.scene},
          {"budget_ms", arguments_.budget_ms},
          {"horizon_s", horizon_},
          {"feature_m", feature_},
          {"threads", arguments_.threads},
          {"spacing_m", choice_.spacing},
          {"support_ratio", choice_.support_ratio},
          {"mach_factor", choice_.mach_factor},
          {"effects", chosen_->effects},
          {"left_out", left_out_},
          {"measured_over_predicted_time", timeRatio()},
          {"predicted",
           {{"frame_ms", choice_.time.milliseconds},
            {"particles", choice_.time.particles},
            {"steps_per_frame", choice_.time.steps},
            {"us_per_particle_step", choice_.time.microseconds},
            {"flow_error", at_rows_.flow},
            {"compression", choice_.error.compression}}},
          {"measured",
           {{"frame_ms", measured_.frame_ms},
            {"particles", measured_.particles},
            {"steps_per_frame", 1.0 / (measured_.dt * chosen_->frame_rate)},
            {"us_per_particle_step", measured_.microseconds},
            {"flow_error", flow_error_},
            {"compression", measured_.density_error}}}};
}

/// Of a choice that cannot be made.
ExitCode codeOf(StatusCode code) {
  switch (code) {
    case StatusCode::capacity:
      return ExitCode::missed;  // nothing fits
    case StatusCode::invalid_argument:
    case StatusCode::not_found:
      return ExitCode::usage;
    default:
      return ExitCode::failed;
  }
}

ExitCode run(const Arguments& arguments) {
  auto loaded = scene::loadScene(arguments.scene);
  if (!loaded) return fail(ExitCode::usage, loaded.status().message());
  Chooser chooser{std::move(*loaded), arguments};
  if (Status status = chooser.check(); !status.ok()) return fail(ExitCode::usage, status.message());
  {
    Progress progress{"choose"};
    progress.report(0.0);
    if (Status status = chooser.decide(); !status.ok()) { return fail(codeOf(status.code()), status.message()); }
    progress.report(0.6);
    if (Status status = chooser.measure(); !status.ok()) return fail(ExitCode::failed, status.message());
  }
  if (!arguments.output.empty()) {
    if (Status status = writeTextFile("", arguments.output, chooser.text()); !status.ok())
      return fail(ExitCode::failed, status.message());
  }
  if (arguments.json != "-") chooser.print();
  if (std::abs(chooser.timeRatio() - 1.0) > kTrusted) {
    fmt::print(stderr,
               "the measured time is {:.2f} of the predicted one: other programs took time from one of the two; let the machine "
               "come to rest and choose again\n",
               chooser.timeRatio());
  }
  if (Status status = writeJson(arguments.json, chooser.toJson()); !status.ok()) return fail(ExitCode::failed, status.message());
  return ExitCode::done;
}

}  // namespace

void addChooseCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("choose", "Choose the resolution of a scene for a time budget on this machine");
  command->add_option("--scene", arguments->scene, "Scene to be resolved")->required()->type_name("SCENE");
  command->add_option("--budget-ms", arguments->budget_ms, "Time that a frame may take when the scene is full, ms")
      ->capture_default_str()
      ->check(finiteIn(0.01, 1e5));
  command->add_option("--error", arguments->error, "Largest error, 0.05 for 5 %; default the smallest that the budget allows")
      ->check(finiteIn(1e-4, 1.0));
  command
      ->add_option("--horizon", arguments->horizon,
                   "Simulated time after which the scene is full, s; default its horizon_s, or 5")
      ->check(finiteIn(0.01, 1000.0));
  command->add_option("--feature-mm", arguments->feature_mm, "What must be resolved, mm; default the narrowest wound or block")
      ->check(finiteIn(0.01, 1000.0));
  command->add_option("--results", arguments->results, "Take errors from here, a file of `accuracy --json`; default short runs")
      ->type_name("FILE");
  command->add_option("--threads", arguments->threads, "Threads that the daemon will have")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("-o,--output", arguments->output, "Write the scene here")->type_name("SCENE_OUT");
  addJsonOption(*command, arguments->json);
  command->footer("Exit code 1: nothing fits, with the figure that decides.");
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
