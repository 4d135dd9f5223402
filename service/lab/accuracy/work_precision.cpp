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

/// What runs of the cases took, and at which knobs.
class CostTable {
 public:
  /// Of one run, s; 0 of a case that did not run yet.
  double estimate(const Setting& setting) const {
    const auto found = known_.find(setting.which->name);
    if (found == known_.end()) return 0.0;
    return estimateSeconds(*setting.which, found->second.knobs, found->second.seconds, setting.knobs);
  }
  void add(const Setting& setting, double seconds) {
    if (setting.knob == "spacing" || setting.knob == "base") known_[setting.which->name] = {setting.knobs, seconds};
  }

 private:
  struct Known {
    Knobs knobs;
    double seconds = 0.0;
  };
  std::map<std::string_view, Known> known_;
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
    const RunCost& cost = result->cost;
    if (!(cost.simulated > 0.0)) return Status{StatusCode::internal, "too short to be timed"};
    measurement.figures.clear();
    for (const std::string_view name : errorFiguresOf(*setting.which)) {
      const Figure* figure = result->find(name);
      if (figure == nullptr) return Status{StatusCode::internal, fmt::format("no figure '{}'", name)};
      measurement.figures.push_back(*figure);
    }
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

/// `runs` runs or, where they do not fit, one. What comes of them goes to the results.
void measureWithin(const Setting& setting, int runs, TimeBudget& budget, CostTable& known, AccuracyResults& results) {
  const double estimate = known.estimate(setting);
  if (!budget.fits(estimate) || !(budget.left() > 0.0)) {
    results.left_out.push_back(
        {setting, fmt::format("a run needs about {:.0f} s, {:.0f} s were left", estimate, std::max(0.0, budget.left()))});
    return;
  }
  const double begin = wallSeconds();
  double one_run = 0.0;
  auto measured = measure(setting, budget.fits(runs * estimate) ? runs : 1, [&] {
    const double now = wallSeconds() - begin;
    one_run = one_run > 0.0 ? one_run : now;
    return now + one_run <= budget.left();
  });
  const double took = wallSeconds() - begin;
  budget.spend(took);
  if (!measured) {
    results.left_out.push_back({setting, measured.status().message()});
    return;
  }
  known.add(setting, took / measured->runs);
  results.measurements.push_back(std::move(*measured));
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

const Figure* Measurement::find(std::string_view figure) const {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& one) { return one.name == figure; });
  return found == figures.end() ? nullptr : &*found;
}

std::vector<std::string_view> errorFiguresOf(const ValidationCase& which) {
  std::vector<std::string_view> names;
  for (const std::string_view name : which.error_figures) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

std::vector<const ValidationCase*> casesIn(const AccuracyResults& results) {
  std::vector<const ValidationCase*> cases;
  for (const ValidationCase& one : validationCases()) {
    const bool measured = std::any_of(results.measurements.begin(), results.measurements.end(),
                                      [&](const Measurement& measurement) { return measurement.setting.which == &one; });
    if (measured) cases.push_back(&one);
  }
  return cases;
}

AccuracyResults measureAccuracy(const AccuracyOptions& options, const std::function<void(double)>& progress) {
  AccuracyResults results;
  results.machine = thisMachine();
  results.minutes = options.minutes;
  const double start = wallSeconds();
  const double whole = 60.0 * options.minutes;
  const double for_effects = options.effects ? kEffectsPart * whole : 0.0;
  CostTable known;
  TimeBudget budget{whole - for_effects};
  std::vector<Setting> settings = settingsOf(options.cases, options.knobs);
  for (auto round = settings.begin(); round != settings.end();) {
    const auto end = std::find_if(round, settings.end(), [&](const Setting& one) { return one.round != round->round; });
    std::stable_sort(round, end, [&](const Setting& a, const Setting& b) { return known.estimate(a) < known.estimate(b); });
    for (; round != end; ++round) {
      measureWithin(*round, options.runs, budget, known, results);
      progress(std::min(1.0, (wallSeconds() - start) / whole));
    }
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

SeparatedErrors separate(const std::vector<Measurement>& measurements, const ValidationCase& which, std::string_view figure) {
  std::vector<const Measurement*> own;
  const Measurement* base = nullptr;
  for (const Measurement& one : measurements) {
    if (one.setting.which != &which || one.find(figure) == nullptr) continue;
    own.push_back(&one);
    if (one.setting.knob == "base") base = &one;
  }
  SeparatedErrors errors;
  if (base == nullptr) return errors;
  const Figure& at_base = *base->find(figure);
  errors.total = at_base.error;
  const double scale = at_base.reference ? std::abs(*at_base.reference) : 1.0;
  const auto change = [&](const Measurement* one) -> std::optional<double> {
    if (one == nullptr) return std::nullopt;
    return std::abs(one->find(figure)->value - at_base.value) / scale;
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
    error.push_back(one->find(figure)->error);
  }
  if (across.size() >= 3) errors.spacing_order = convergenceOrder(across, error);
  return errors;
}

}  // namespace bleedsim::lab
