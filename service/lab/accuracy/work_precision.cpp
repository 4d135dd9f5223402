#include "service/lab/accuracy/work_precision.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <numeric>

namespace bleedsim::lab {
namespace {

constexpr double kEffectsPart = 0.1;  // of the time

double wallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// What a run of a case took, and at which knobs.
struct Known {
  Knobs knobs;
  double seconds = 0.0;
};

/// A body of blood with every effect, for the bar of what each costs.
sph::WorldDescription everyEffect() {
  sph::WorldDescription scene;
  scene.spacing = 0.001;
  scene.support_ratio = 2.5;
  scene.effects.gravity.emplace();
  scene.effects.pressure.emplace();
  scene.effects.viscosity.emplace().rheology = sph::CarreauYasudaRheology{};
  scene.effects.surface_tension.emplace();
  scene.effects.platelets.emplace();
  scene.effects.core_radius.emplace();
  scene.effects.repulsion.emplace();
  scene.effects.adhesion.emplace();
  scene.effects.applied_force.emplace();
  return scene;
}

/// The same numbers in every run, so only the first one's figure is kept; the times differ.
Result<Measurement> measure(const Setting& setting, int runs, const std::function<bool()>& has_time) {
  Measurement measurement;
  measurement.setting = setting;
  std::vector<double> cpu;
  std::vector<double> wall;
  std::vector<double> microseconds;
  for (int k = 0; k < runs && (k == 0 || has_time()); ++k) {
    const auto result = setting.which->run(setting.knobs);
    if (!result) return result.status();
    const Figure* figure = result->find(setting.which->error_figure);
    if (figure == nullptr) return Status{StatusCode::internal, fmt::format("no figure '{}'", setting.which->error_figure)};
    const RunCost& cost = result->cost;
    if (!(cost.simulated > 0.0)) return Status{StatusCode::internal, "too short to be timed"};
    measurement.value = figure->value;
    measurement.reference = figure->reference;
    measurement.error = figure->error;
    measurement.particles = cost.particles;
    measurement.steps = cost.steps;
    cpu.push_back(cost.cpu / cost.simulated);
    wall.push_back(cost.wall / cost.simulated);
    microseconds.push_back(cost.microseconds());
    ++measurement.runs;
  }
  measurement.cpu = spreadOf(cpu);
  measurement.wall = spreadOf(wall);
  measurement.microseconds = spreadOf(microseconds);
  return measurement;
}

/// The extreme measurement of a knob of one case by `key`; null without one.
template <class Key>
const Measurement* furthest(const std::vector<const Measurement*>& own, const std::string& knob, Key key) {
  const Measurement* found = nullptr;
  for (const Measurement* one : own) {
    if (one->setting.knob != knob) continue;
    if (found == nullptr || key(one->setting.knobs) > key(found->setting.knobs)) found = one;
  }
  return found;
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {median, values.front(), values.back()};
}

AccuracyResults measureAccuracy(const AccuracyOptions& options, const std::function<void(double)>& progress) {
  AccuracyResults results;
  results.machine = thisMachine();
  results.minutes = options.minutes;
  const double start = wallSeconds();
  const double whole = 60.0 * options.minutes;
  const double for_effects = options.effects ? kEffectsPart * whole : 0.0;
  TimeBudget budget{whole - for_effects};
  std::map<std::string_view, Known> known;
  for (const Setting& setting : settingsOf(options.cases, options.knobs)) {
    const auto before = known.find(setting.which->name);
    const bool first = before == known.end();
    const double estimate =
        first ? 0.0 : options.runs * estimateSeconds(*setting.which, before->second.knobs, before->second.seconds, setting.knobs);
    if (!budget.fits(estimate) || !(budget.left() > 0.0)) {
      results.left_out.push_back(
          {setting, fmt::format("needs about {:.0f} s, {:.0f} s were left", estimate, std::max(0.0, budget.left()))});
      continue;
    }
    const double begin = wallSeconds();
    double one_run = 0.0;
    auto measured = measure(setting, options.runs, [&] {
      const double now = wallSeconds() - begin;
      one_run = one_run > 0.0 ? one_run : now;
      return now + one_run <= budget.left();
    });
    const double took = wallSeconds() - begin;
    budget.spend(took);
    if (measured) {
      if (setting.knob == "spacing" || setting.knob == "base")
        known[setting.which->name] = {setting.knobs, took / measured->runs};
      results.measurements.push_back(std::move(*measured));
    } else {
      results.left_out.push_back({setting, measured.status().message()});
    }
    progress(std::min(1.0, (wallSeconds() - start) / whole));
  }
  if (options.effects) {
    const CostOptions costs{.particles = 4000, .seconds = std::max(1.0, for_effects)};
    auto effects = measureEffectCosts(everyEffect(), costs, [](double) {});
    if (effects) results.effects = std::move(*effects);
  }
  results.took = wallSeconds() - start;
  return results;
}

std::vector<std::size_t> paretoFront(const std::vector<double>& time, const std::vector<double>& error) {
  std::vector<std::size_t> order(time.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return time[a] != time[b] ? time[a] < time[b] : error[a] < error[b]; });
  std::vector<std::size_t> front;
  for (const std::size_t k : order) {
    if (front.empty() || error[k] < error[front.back()]) front.push_back(k);
  }
  return front;
}

std::optional<double> convergenceOrder(const std::vector<double>& x, const std::vector<double>& error) {
  double count = 0.0, sum_x = 0.0, sum_e = 0.0, sum_xx = 0.0, sum_xe = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!(x[k] > 0.0) || !(error[k] > 0.0)) continue;
    const double lx = std::log(x[k]);
    const double le = std::log(error[k]);
    count += 1.0;
    sum_x += lx;
    sum_e += le;
    sum_xx += lx * lx;
    sum_xe += lx * le;
  }
  const double spread = count * sum_xx - sum_x * sum_x;
  if (count < 2.0 || !(spread > 1e-12)) return std::nullopt;
  return -(count * sum_xe - sum_x * sum_e) / spread;
}

SeparatedErrors separate(const std::vector<Measurement>& measurements, const ValidationCase& which) {
  std::vector<const Measurement*> own;
  const Measurement* base = nullptr;
  for (const Measurement& one : measurements) {
    if (one.setting.which != &which) continue;
    own.push_back(&one);
    if (one.setting.knob == "base") base = &one;
  }
  SeparatedErrors errors;
  if (base == nullptr) return errors;
  errors.total = base->error;
  const double scale = base->reference ? std::abs(*base->reference) : 1.0;
  const auto change = [&](const Measurement* one) -> std::optional<double> {
    if (one == nullptr) return std::nullopt;
    return std::abs(one->value - base->value) / scale;
  };
  const Measurement* finest = furthest(own, "spacing", [](const Knobs& knobs) { return double(knobs.across); });
  if (finest != nullptr && finest->setting.knobs.across > base->setting.knobs.across) errors.spacing = change(finest);
  errors.time_step = change(furthest(own, "cfl", [](const Knobs& knobs) { return -knobs.cfl; }));
  const Measurement* stiff = furthest(own, "mach", [](const Knobs& knobs) { return knobs.mach_factor; });
  if (stiff != nullptr && stiff->setting.knobs.mach_factor > base->setting.knobs.mach_factor)
    errors.compressibility = change(stiff);
  errors.precision = change(furthest(own, "precision", [](const Knobs&) { return 0.0; }));
  std::vector<double> across;
  std::vector<double> error;
  for (const Measurement* one : own) {
    if (one->setting.knob != "spacing" && one->setting.knob != "base") continue;
    across.push_back(one->setting.knobs.across);
    error.push_back(one->error);
  }
  if (across.size() >= 3) errors.spacing_order = convergenceOrder(across, error);
  return errors;
}

}  // namespace bleedsim::lab
