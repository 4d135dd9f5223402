#include "tests/bench/soak/figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <iterator>

namespace bleedsim::soak {
namespace {

struct Row {
  const char* name;
  const char* title;
  double quiet;
  double loud;
};

std::vector<Row> rows(const Figures& quiet, const Figures& loud) {
  const auto both = [&](const char* name, const char* title, auto figure) {
    return Row{name, title, figure(quiet), figure(loud)};
  };
  const auto rate = [](double count, double seconds) { return seconds > 0.0 ? count / seconds : 0.0; };
  return {
      both("steps_per_s", "solver steps a second",
           [&](const Figures& f) { return rate(static_cast<double>(f.steps), f.wall_s); }),
      both("frames_per_s", "frames a second", [&](const Figures& f) { return rate(static_cast<double>(f.frames), f.wall_s); }),
      both("step_p50_us", "step, median, us", [](const Figures& f) { return percentile(f.step_us, 0.5); }),
      both("step_p99_us", "step, 99th percentile, us", [](const Figures& f) { return percentile(f.step_us, 0.99); }),
      both("ping_p50_ms", "ping, median, ms", [](const Figures& f) { return percentile(f.ping_ms, 0.5); }),
      both("ping_p99_ms", "ping, 99th percentile, ms", [](const Figures& f) { return percentile(f.ping_ms, 0.99); }),
      both("reply_p50_ms", "reply to a command, median, ms", [](const Figures& f) { return percentile(f.reply_ms, 0.5); }),
      both("reply_p99_ms", "reply, 99th percentile, ms", [](const Figures& f) { return percentile(f.reply_ms, 0.99); }),
      both("reply_max_ms", "reply, longest, ms", [](const Figures& f) { return percentile(f.reply_ms, 1.0); }),
      both("replies_in_50_ms", "replies within 50 ms, %",
           [&](const Figures& f) {
             const auto within = std::count_if(f.reply_ms.begin(), f.reply_ms.end(), [](double ms) { return ms <= 50.0; });
             return 100.0 * rate(static_cast<double>(within), static_cast<double>(f.reply_ms.size()));
           }),
      both("commands", "commands", [](const Figures& f) { return static_cast<double>(f.reply_ms.size()); }),
      both("commands_lost", "commands without an answer", [](const Figures& f) { return static_cast<double>(f.commands_lost); }),
      both("busy", "commands answered busy", [](const Figures& f) { return static_cast<double>(f.busy); }),
      both("gaps", "frames missing", [](const Figures& f) { return static_cast<double>(f.gaps); }),
      both("memory_first_mib", "resident memory at the start, MiB",
           [](const Figures& f) { return f.memory_mib.empty() ? 0.0 : f.memory_mib.front(); }),
      both("memory_middle_mib", "resident memory in the middle, MiB",
           [](const Figures& f) { return f.memory_mib.empty() ? 0.0 : f.memory_mib[f.memory_mib.size() / 2]; }),
      both("memory_last_mib", "resident memory at the end, MiB",
           [](const Figures& f) { return f.memory_mib.empty() ? 0.0 : f.memory_mib.back(); }),
      both("memory_max_mib", "resident memory, most, MiB", [](const Figures& f) { return percentile(f.memory_mib, 1.0); }),
  };
}

}  // namespace

double percentile(std::vector<double> values, double p) {
  if (values.empty()) return 0.0;
  const auto index = static_cast<std::size_t>(std::ceil(p * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
  return values[index];
}

double residentMiB(int pid) {
  std::ifstream statm{fmt::format("/proc/{}/statm", pid)};
  double pages = 0.0;
  double resident = 0.0;
  statm >> pages >> resident;
  return resident * 4096.0 / (1 << 20);
}

std::string table(const Figures& quiet, const Figures& loud) {
  std::string out = fmt::format("| {:<36} | {:>10} | {:>10} | {:>6} |\n|{:-<38}|{:->12}|{:->12}|{:->8}|\n", "", "quiet", "loud",
                                "ratio", "", ":", ":", ":");
  for (const Row& row : rows(quiet, loud)) {
    const std::string ratio = row.quiet > 0.0 ? fmt::format("{:.3g}", row.loud / row.quiet) : std::string{};
    out += fmt::format("| {:<36} | {:>10.4g} | {:>10.4g} | {:>6} |\n", row.title, row.quiet, row.loud, ratio);
  }
  return out;
}

std::string json(const Figures& quiet, const Figures& loud) {
  std::string halves[2];
  for (const Row& row : rows(quiet, loud)) {
    halves[0] += fmt::format("{}\"{}\": {}", halves[0].empty() ? "" : ", ", row.name, row.quiet);
    halves[1] += fmt::format("{}\"{}\": {}", halves[1].empty() ? "" : ", ", row.name, row.loud);
  }
  return fmt::format("{{\"quiet\": {{{}}}, \"loud\": {{{}}}}}\n", halves[0], halves[1]);
}

}  // namespace bleedsim::soak
