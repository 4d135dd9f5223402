// bleedlab accuracy: error against time.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "service/lab/accuracy/chapter.h"
#include "service/lab/accuracy/report.h"
#include "service/lab/app.h"
#include "service/lab/case_names.h"
#include "service/lab/json_option.h"
#include "service/lab/lab_files.h"
#include "service/lab/markdown_block.h"
#include "service/lab/progress.h"
#include "service/status/number_text.h"

namespace bleedsim::lab {
namespace {

constexpr const char* kBlock = "bleedlab accuracy";

struct Arguments {
  std::vector<std::string> cases = accuracyCaseNames();
  std::vector<std::string> knobs = knobNames();
  double minutes = 6.0;
  bool no_effects = false;
  std::string folder;
  std::string chapter;
  std::string json;
};

/// The command line that these arguments come from.
std::string lineOf(const Arguments& arguments) {
  std::string line = "bleedlab accuracy";
  if (arguments.cases != accuracyCaseNames()) line += fmt::format(" --cases {}", fmt::join(arguments.cases, ","));
  if (arguments.knobs != knobNames()) line += fmt::format(" --knobs {}", fmt::join(arguments.knobs, ","));
  line += fmt::format(" --minutes {}", arguments.minutes);
  if (arguments.no_effects) line += " --no-effects";
  if (!arguments.folder.empty()) line += " -o " + arguments.folder;
  if (!arguments.chapter.empty()) line += " --chapter " + arguments.chapter;
  if (!arguments.json.empty()) line += " --json " + arguments.json;
  return line;
}

/// The chapter into the file, whose links lead to the report's pictures.
Status writeChapter(const Arguments& arguments, const AccuracyResults& results, const std::vector<WrittenPlot>& plots) {
  std::error_code error;
  const std::filesystem::path links =
      std::filesystem::relative(arguments.folder, std::filesystem::absolute(arguments.chapter, error).parent_path(), error);
  if (error) return {StatusCode::io, fmt::format("no way from '{}' to '{}'", arguments.chapter, arguments.folder)};
  const std::string text = fmt::format("\nMade by `{}` on {}\n{}\n", lineOf(arguments), chapterOf(results),
                                       picturesOf(plots, links.generic_string() + "/"));
  if (Status status = replaceBlock(arguments.chapter, kBlock, text); !status.ok()) return status;
  fmt::print(stderr, "wrote {}\n", arguments.chapter);
  return {};
}

ExitCode run(const Arguments& arguments) {
  const auto cases = casesOf(arguments.cases);
  if (!cases) return fail(ExitCode::usage, cases.status().message());
  for (const ValidationCase* one : *cases) {
    if (!one->measuresAccuracy())
      return fail(ExitCode::usage, fmt::format("case '{}' has no figure to judge accuracy by; leave it out", one->name));
  }
  if (!arguments.chapter.empty()) {
    if (Status status = checkBlock(arguments.chapter, kBlock); !status.ok()) return fail(ExitCode::usage, status.message());
  }
  if (Status status = makeFolder(arguments.folder); !status.ok()) return fail(ExitCode::failed, status.message());
  AccuracyOptions options;
  options.cases = *cases;
  options.knobs = arguments.knobs;
  options.minutes = arguments.minutes;
  options.effects = !arguments.no_effects;
  AccuracyResults results;
  {
    Progress progress{"accuracy"};
    results = measureAccuracy(options, [&](double part) { progress.report(part); });
  }
  if (results.measurements.empty())
    return fail(ExitCode::failed,
                "nothing could be measured" + (results.left_out.empty() ? "" : ": " + results.left_out.front().reason));
  if (arguments.json != "-") fmt::print("{}\n{}", chapterOf(results), measurementTable(results));
  if (Status status = writeJson(arguments.json, toJson(results)); !status.ok()) return fail(ExitCode::failed, status.message());
  if (!arguments.folder.empty()) {
    std::vector<WrittenPlot> plots;
    Status status = writeReport(arguments.folder, results, plots);
    if (status.ok() && !arguments.chapter.empty()) status = writeChapter(arguments, results, plots);
    if (!status.ok()) return fail(ExitCode::failed, status.message());
  }
  return ExitCode::done;
}

}  // namespace

void addAccuracyCommand(CLI::App& app, Context& context) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("accuracy", "Measure error against time over the solver's knobs");
  command->add_option("--cases", arguments->cases, "Validation cases that have an error figure")
      ->capture_default_str()
      ->delimiter(',')
      ->type_name("NAME");
  command->add_option("--knobs", arguments->knobs, "What is varied, one at a time")
      ->capture_default_str()
      ->delimiter(',')
      ->check(CLI::IsMember(knobNames()));
  command->add_option("--minutes", arguments->minutes, "Wall time that is kept; what does not fit is named as left out")
      ->capture_default_str()
      ->check(finiteIn(0.01, 600.0));
  command->add_flag("--no-effects", arguments->no_effects, "Leave the cost of each effect out")->disable_flag_override();
  CLI::Option* folder =
      command->add_option("-o,--output", arguments->folder, "Write accuracy.csv, accuracy.md and plots here")->type_name("DIR");
  command
      ->add_option(
          "--chapter", arguments->chapter,
          "Markdown file in which the results replace what stands between the lines '<!-- begin bleedlab accuracy -->' and "
          "'<!-- end bleedlab accuracy -->'")
      ->type_name("FILE")
      ->needs(folder);
  addJsonOption(*command, arguments->json);
  command->callback([arguments, &context] { context.action = [arguments] { return run(*arguments); }; });
}

}  // namespace bleedsim::lab
