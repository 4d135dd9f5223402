// Files that a command leaves, each named on stderr.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/picture/plot.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// Makes the folder and those above it; nothing for an empty name.
Status makeFolder(const std::string& folder);

/// FOLDER/NAME with the text.
Status writeTextFile(const std::string& folder, const std::string& name, const std::string& text);

/// NAME.csv, NAME.gnuplot and, with gnuplot, a small NAME.png, whose file name goes to `picture`; empty without gnuplot, whose
/// absence is told on stderr.
Status writeSmallPlot(const std::string& folder, const std::string& name, const picture::LinePlot& plot, std::string& picture);
Status writeSmallPlot(const std::string& folder, const std::string& name, const picture::BarPlot& plot, std::string& picture);

/// To stdout if `path` is "-", nowhere if it is empty.
Status writeJson(const std::string& path, const nlohmann::json& json);

}  // namespace bleedsim::lab
