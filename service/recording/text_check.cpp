#include "service/recording/text_check.h"

#include <cstddef>
#include <cstdint>

namespace bleedsim::recording {

bool isUtf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const auto first = static_cast<std::uint8_t>(text[at]);
    ++at;
    if (first < 0x80U) continue;
    std::size_t more = 0;
    std::uint32_t code = 0;
    std::uint32_t least = 0;
    if ((first & 0xe0U) == 0xc0U) {
      more = 1, code = first & 0x1fU, least = 0x80U;
    } else if ((first & 0xf0U) == 0xe0U) {
      more = 2, code = first & 0x0fU, least = 0x800U;
    } else if ((first & 0xf8U) == 0xf0U) {
      more = 3, code = first & 0x07U, least = 0x10000U;
    } else {
      return false;
    }
    if (more > text.size() - at) return false;
    for (std::size_t i = 0; i < more; ++i, ++at) {
      const auto next = static_cast<std::uint8_t>(text[at]);
      if ((next & 0xc0U) != 0x80U) return false;
      code = (code << 6U) | (next & 0x3fU);
    }
    if (code < least || code > 0x10ffffU || (code >= 0xd800U && code <= 0xdfffU)) return false;
  }
  return true;
}

}  // namespace bleedsim::recording
