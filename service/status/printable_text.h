// Text that a person, protobuf and a terminal can take: UTF-8 without control characters. One rule for scenes, requests and
// clients.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "service/status/status.h"

namespace bleedsim {

/// Bytes of the UTF-8 character at the start of the text, which is not empty; 0 if it is malformed, overlong, a surrogate or
/// beyond U+10FFFF.
inline std::size_t characterLength(std::string_view text) {
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

/// `character` is a whole one by characterLength().
inline bool isControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  const bool c1 = first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  return first < 0x20 || first == 0x7F || c1;
}

/// invalid_argument names the first byte that is not UTF-8, or the first control character; line breaks and tabs are allowed
/// where `lines` says so.
inline Status checkPrintable(std::string_view text, bool lines = false) {
  const auto refused = [&](std::size_t at, const char* what) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::string hex{kDigits[byte >> 4U], kDigits[byte & 15U]};
    return Status{StatusCode::invalid_argument, "byte " + std::to_string(at) + " (0x" + hex + ") is " + what};
  };
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = characterLength(text.substr(i));
    if (length == 0) return refused(i, "not UTF-8; use text in UTF-8");
    const std::string_view character = text.substr(i, length);
    if (isControl(character) && !(lines && (character == "\n" || character == "\t"))) {
      return refused(i, "a control character; use printable characters");
    }
    i += length;
  }
  return {};
}

}  // namespace bleedsim
