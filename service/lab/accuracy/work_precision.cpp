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

/// A measurement with what each run took.
class Repeated {
 public:
  explicit Repeated(const Setting& setting) { measurement_.setting = setting; }

  const Setting& setting() const { return measurement_.setting; }

  /// One run more. The figures are the same in every run; the times differ.
  Status run() {
    const Setting& setting = measurement_.setting;
    const auto result = setting.which->run(setting.knobs);
    if (!result) return result.status();
    measurement_.figures.clear();
    for (const std::string_view name : errorFiguresOf(*setting.which)) {
      const Figure* figure = result->find(name);
      if (figure == nullptr) return {StatusCode::internal, fmt::format("no figure '{}'", name)};
      measurement_.figures.push_back(*figure);
    }
    const RunCost& cost = result->cost;
    if (!(cost.simulated > 0.0)) return {StatusCode::internal, "too short to be timed"};
    measurement_.particles = cost.particles;
    measurement_.steps = cost.steps;
    ++measurement_.runs;
    cpu_.push_back(cost.cpu / cost.simulated);
    wall_.push_back(cost.wall / cost.simulated);
    microseconds_.push_back(cost.microseconds());
    return {};
  }

  Measurement measurement() const {
    Measurement whole = measurement_;
    whole.cpu = spreadOf(cpu_);
    whole.wall = spreadOf(wall_);
    whole.microseconds = spreadOf(microseconds_);
    return whole;
  }

 private:
  Measurement measurement_;
  std::vector<double> cpu_, wall_, microseconds_;
};

/// A run whose time is taken from the budget.
Status runWithin(Repeated& repeated, TimeBudget& budget, CostTable& known) {
  const double begin = wallSeconds();
  const Status status = repeated.run();
  const double took = wallSeconds() - begin;
  budget.spend(took);
  if (status.ok()) known.add(repeated.setting(), took);
  return status;
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
  std::vector<Repeated> all;
  const auto fits = [&](double needs) { return budget.fits(needs) && budget.left() > 0.0; };
  for (auto round = settings.begin(); round != settings.end();) {
    const auto end = std::find_if(round, settings.end(), [&](const Setting& one) { return one.round != round->round; });
    std::stable_sort(round, end, [&](const Setting& a, const Setting& b) { return known.estimate(a) < known.estimate(b); });
    for (; round != end; ++round) {
      const double needs = known.estimate(*round);
      if (!fits(needs)) {
        results.left_out.push_back({*round, "no time was left", needs});
        continue;
      }
      Repeated once{*round};
      const Status status = runWithin(once, budget, known);
      if (status.ok())
        all.push_back(std::move(once));
      else
        results.left_out.push_back({*round, status.message(), {}});
      progress(std::min(1.0, (wallSeconds() - start) / whole));
    }
  }
  for (int run = 1; run < options.runs; ++run) {
    for (Repeated& one : all) {
      if (!fits(known.estimate(one.setting()))) continue;
      // What ran once runs again; if not, its first run stands.
      static_cast<void>(runWithin(one, budget, known));
      progress(std::min(1.0, (wallSeconds() - start) / whole));
    }
  }
  for (const Repeated& one : all) results.measurements.push_back(one.measurement());
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
