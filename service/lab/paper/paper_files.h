// The files that an experiment leaves, each named on stderr. Without a folder nothing is written.
#pragma once

#include <string>

#include "service/lab/paper/paper_options.h"
#include "service/picture/contact_sheet.h"
#include "service/picture/plot.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// NAME.png in the options' folder.
Status writePicture(const PaperOptions& options, const std::string& name, const picture::Image& image);
/// NAME.csv and, with gnuplot, NAME.png; says on stderr what is missing.
Status writeLinePlot(const PaperOptions& options, const std::string& name, const picture::LinePlot& plot);
/// NAME.json and NAME.txt.
Status writeReport(const PaperOptions& options, const std::string& name, const PaperReport& report);

}  // namespace bleedsim::lab
