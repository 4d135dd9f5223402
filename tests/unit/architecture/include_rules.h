// Who may include whom: the layers' table of config/cmake/Layers.cmake, and which layer may see which library.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace bleedsim::tests {

struct Include {
  std::string target;
  bool quoted = false;
};

/// The include on this line, if there is one.
std::optional<Include> parseInclude(std::string_view line);

/// Layer -> the other layers it may use.
using LayerTable = std::map<std::string, std::set<std::string>>;
/// Reads the set(BLEEDSIM_MAY_layer others...) lines.
LayerTable parseLayerTable(std::string_view cmake);

/// "service/sph/world.h" -> "sph", "clients/..." -> "client", "idl/..." -> "idl"; empty: not in a layer.
std::string layerOf(std::string_view path);

/// What is wrong with that include in that file, or empty.
std::string problemOf(std::string_view path, const Include& include, const LayerTable& table);

}  // namespace bleedsim::tests
