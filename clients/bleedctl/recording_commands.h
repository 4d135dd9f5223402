// The commands on recordings, one function each.
#pragma once

#include <CLI/CLI.hpp>

#include "clients/bleedctl/context.h"

namespace bleedsim::bleedctl {

void addRecord(CLI::App& app, Context& context);
void addInfo(CLI::App& app, Context& context);
void addRecover(CLI::App& app, Context& context);
void addExport(CLI::App& app, Context& context);
void addRender(CLI::App& app, Context& context);

}  // namespace bleedsim::bleedctl
