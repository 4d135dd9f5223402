#include <cstddef>
#include <fmt/format.h>

#include "service/scene/validate.h"

namespace bleedsim::scene {
namespace {

/// Bytes of the UTF-8 character at the start of the text; 0 if it is malformed, overlong, a surrogate or beyond U+10FFFF.
std::size_t characterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned char second = byte(1);
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool outside = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return overlong || outside ? 0 : length;
}

bool isControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  const bool c1 = first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  return first < 0x20 || first == 0x7F || c1;
}

void requirePrintable(std::string_view path, std::string_view text, int most_bytes, bool lines, ProblemList& problems) {
  if (text.size() > static_cast<std::size_t>(most_bytes)) {
    problems.add(path, fmt::format("has {} bytes, allowed are at most {}", text.size(), most_bytes));
  }
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = characterLength(text.substr(i));
    if (length == 0) {
      problems.add(
          path, fmt::format("byte {} (0x{:02x}) is not UTF-8; write the text in UTF-8", i, static_cast<unsigned char>(text[i])));
      return;
    }
    const std::string_view character = text.substr(i, length);
    if (isControl(character) && !(lines && (character == "\n" || character == "\t"))) {
      problems.add(path, fmt::format("byte {} (0x{:02x}) is a control character; use printable characters", i,
                                     static_cast<unsigned char>(text[i])));
      return;
    }
    i += length;
  }
}

}  // namespace

bool requireName(std::string_view path, std::string_view name, ProblemList& problems) {
  const std::size_t before = problems.count();
  requirePrintable(path, name, kMaxNameBytes, false, problems);
  return problems.count() == before;
}

void validateText(const Scene& scene, ProblemList& problems) {
  requireName("name", scene.name(), problems);
  requireName("frame_id", scene.frame_id(), problems);
  requirePrintable("description", scene.description(), kMaxDescriptionBytes, true, problems);
}

}  // namespace bleedsim::scene
