// --json [FILE], the same in every command that has no file of its own among its arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace bleedsim::lab {

/// `path` for writeJson(): what was given, "-" where no name was.
inline void addJsonOption(CLI::App& command, std::string& path) {
  command
      .add_option(
          "--json",
          [&path](const CLI::results_t& given) {
            path = given.front().empty() ? "-" : given.front();
            return true;
          },
          "Write JSON to FILE; without one to stdout, in place of the table")
      ->type_name("[FILE]")
      ->expected(0, 1);
}

}  // namespace bleedsim::lab
