// A bar chart of what each effect costs.
#pragma once

#include <string>

#include "service/lab/effect_costs.h"
#include "service/picture/plot.h"

namespace bleedsim::lab {

/// Microseconds per particle and step; `alone` says what the bars of an effect that is on alone stand for.
picture::BarPlot costPlot(const EffectCosts& costs, const std::string& title, const std::string& alone);

}  // namespace bleedsim::lab
