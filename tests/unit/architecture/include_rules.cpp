#include "tests/unit/architecture/include_rules.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace bleedsim::tests {
namespace {

struct LibraryRule {
  std::string_view prefix;
  std::vector<std::string_view> layers;
};

// A library that a layer needs newly is a decision about the architecture: it is taken here.
const std::vector<LibraryRule>& libraryRules() {
  static const std::vector<LibraryRule> kRules{
      {"hwy/", {"sph", "lab"}},  // lab measures what the machine can do at most
      {"tbb/", {"sph"}},
      {"Eigen/", {"sph", "scene", "dds", "daemon", "picture"}},
      // recording converts IDL samples, whose sequences and strings ddsc allocates; it opens no entity.
      {"dds/", {"transport", "recording"}},
      {"google/protobuf/", {"scene", "recording", "checkpoint"}},
      {"spdlog/", {"daemon"}},
      {"systemd/", {"daemon"}},
      {"CLI/", {"daemon", "client", "lab"}},
      {"nlohmann/", {"lab"}},
      {"fmt/", {"build", "checkpoint", "replay", "scene", "transport", "dds", "recording", "daemon", "client", "lab"}},
      {"lz4", {"recording"}},
      {"zstd", {"recording"}},
      {"zlib", {"recording", "checkpoint", "client"}},
      {"png", {"picture"}},
      {"net/", {"transport"}},
      {"sys/", {"checkpoint", "transport", "daemon", "recording", "client", "picture", "sph"}},  // sph asks for huge pages
  };
  return kRules;
}

constexpr std::string_view kPublicHeaders = "clients/lib/include/";
constexpr std::string_view kExamples = "clients/examples/";

std::string libraryProblem(const std::string& layer, const std::string& target) {
  for (const LibraryRule& rule : libraryRules()) {
    if (!target.starts_with(rule.prefix)) continue;
    if (std::find(rule.layers.begin(), rule.layers.end(), layer) != rule.layers.end()) return {};
    return "layer '" + layer + "' must not use " + std::string{rule.prefix};
  }
  const bool in_folder = target.find('/') != std::string::npos;
  return in_folder ? "no rule says who may use this library: add it to include_rules.cpp" : "";
}

std::string layerOfTarget(std::string_view target) { return target.starts_with("bleedsim/") ? "client" : layerOf(target); }

}  // namespace

std::optional<Include> parseInclude(std::string_view line) {
  const auto skip_blanks = [&line] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
  skip_blanks();
  if (!line.starts_with('#')) return std::nullopt;
  line.remove_prefix(1);
  skip_blanks();
  constexpr std::string_view kWord = "include";
  if (!line.starts_with(kWord)) return std::nullopt;
  line.remove_prefix(kWord.size());
  skip_blanks();
  if (line.empty() || (line.front() != '"' && line.front() != '<')) return std::nullopt;
  const bool quoted = line.front() == '"';
  line.remove_prefix(1);
  const std::size_t end = line.find(quoted ? '"' : '>');
  if (end == std::string_view::npos) return std::nullopt;
  return Include{std::string{line.substr(0, end)}, quoted};
}

LayerTable parseLayerTable(std::string_view cmake) {
  constexpr std::string_view kStart = "set(BLEEDSIM_MAY_";
  LayerTable table;
  for (std::size_t at = cmake.find(kStart); at != std::string_view::npos; at = cmake.find(kStart, at)) {
    at += kStart.size();
    std::istringstream words{std::string{cmake.substr(at, cmake.find(')', at) - at)}};
    std::string layer;
    words >> layer;
    std::set<std::string>& others = table[layer];
    for (std::string other; words >> other;) others.insert(other);
  }
  return table;
}

std::string layerOf(std::string_view path) {
  if (path.starts_with("clients/")) return "client";
  if (path.starts_with("idl/")) return "idl";
  constexpr std::string_view kService = "service/";
  if (!path.starts_with(kService)) return {};
  path.remove_prefix(kService.size());
  const std::size_t slash = path.find('/');
  return slash == std::string_view::npos ? std::string{} : std::string{path.substr(0, slash)};
}

std::string problemOf(std::string_view path, const Include& include, const LayerTable& table) {
  const std::string layer = layerOf(path);
  const auto row = table.find(layer);
  if (row == table.end()) return "layer '" + layer + "' has no row in config/cmake/Layers.cmake";
  const std::string& target = include.target;
  if (target.find("..") != std::string::npos) return "paths start at the root of the repository, without '..'";

  const std::string other = layerOfTarget(target);
  if (other.empty()) {
    if (target.starts_with("tests/") || target.starts_with("config/")) return "the product must not use " + target;
    const std::string problem = libraryProblem(layer, target);
    if (!problem.empty()) return problem;
    // Highway's own idiom is the one quoted include of a library.
    if (include.quoted && !target.starts_with("hwy/")) return "not the path of a file from the root of the repository";
    return {};
  }
  if (path.starts_with(kExamples)) return target.starts_with("bleedsim/") ? "" : "an example uses installed headers only";
  if (!include.quoted) return "our own headers are included in quotes";
  // Installed headers cannot see the middleware nor generated code: a front end compiles without them.
  if (path.starts_with(kPublicHeaders) && other != "client" && other != "status") return "a public header must not use " + target;
  if (other != layer && !row->second.contains(other)) return "layer '" + layer + "' must not use layer '" + other + "'";
  return {};
}

}  // namespace bleedsim::tests
