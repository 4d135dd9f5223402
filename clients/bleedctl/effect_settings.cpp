#include "clients/bleedctl/effect_settings.h"

namespace bleedsim::bleedctl {
namespace {

/// The next line, without its end; `text` then starts after it.
std::string_view takeLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace

std::map<std::string, std::string> effectSettings(std::string_view text) {
  constexpr std::string_view kOpen = " {";
  std::map<std::string, std::string> settings;
  bool inside = false;
  std::string* current = nullptr;
  while (!text.empty()) {
    const std::string_view line = takeLine(text);
    const std::size_t depth = line.find_first_not_of(' ');
    if (depth == std::string_view::npos) continue;
    const std::string_view content = line.substr(depth);
    if (depth == 0) {
      inside = content == "effects {";
      current = nullptr;
    } else if (inside && depth == 2) {
      current = content.ends_with(kOpen) ? &settings[std::string{content.substr(0, content.size() - kOpen.size())}] : nullptr;
    } else if (current != nullptr) {
      if (!current->empty()) *current += ' ';
      *current += content;
    }
  }
  return settings;
}

}  // namespace bleedsim::bleedctl
