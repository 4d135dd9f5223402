#include "service/lab/cost_plot.h"

#include <limits>

namespace bleedsim::lab {

picture::BarPlot costPlot(const EffectCosts& costs, const std::string& title, const std::string& alone) {
  picture::BarPlot plot;
  plot.title = title;
  plot.y.label = "microseconds per particle and step";
  picture::BarSeries with{alone, {}};
  picture::BarSeries without{"off alone, saved", {}};
  for (const EffectCost& effect : costs.effects) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    plot.categories.push_back(effect.name);
    with.values.push_back(effect.alone ? effect.alone->microseconds.value : kNone);
    without.values.push_back(effect.without ? effect.without->microseconds.value : kNone);
  }
  plot.series = {with, without};
  return plot;
}

}  // namespace bleedsim::lab
