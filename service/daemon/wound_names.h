// Which wound a name means. Names of open wounds are unique; the world knows ids only.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace bleedsim::daemon {

/// Belongs to the simulation thread. As large as the world's list of wounds.
class WoundNames {
 public:
  void clear() { ids_.clear(); }
  /// Wound `id` has this name from now on; an empty one is none.
  void set(std::uint32_t id, const std::string& name) {
    forget(id);
    if (!name.empty()) ids_.insert_or_assign(name, id);
  }
  void forget(std::uint32_t id) {
    std::erase_if(ids_, [id](const auto& entry) { return entry.second == id; });
  }
  std::optional<std::uint32_t> find(std::string_view name) const {
    const auto found = ids_.find(name);
    return found == ids_.end() ? std::nullopt : std::optional{found->second};
  }

 private:
  std::map<std::string, std::uint32_t, std::less<>> ids_;
};

}  // namespace bleedsim::daemon
