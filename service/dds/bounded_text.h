// Copies text into the bounded character arrays of the wire types.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace bleedsim::dds {

/// The longest beginning of `text` of at most `limit` bytes that does not cut a UTF-8 sequence.
inline std::string_view cutText(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  std::size_t end = limit;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

/// `text`, or its beginning with "..." at the end where it is longer than `limit` bytes: whole words where the last one starts in
/// the second half, so that a person sees that something is missing and no number is cut to another.
inline std::string shortened(std::string_view text, std::size_t limit) {
  constexpr std::string_view kMore = "...";
  if (text.size() <= limit || limit < kMore.size()) return std::string{cutText(text, limit)};
  std::string_view kept = cutText(text, limit - kMore.size());
  if (text[kept.size()] != ' ' && text[kept.size()] != '\n') {
    const std::size_t gap = kept.find_last_of(" \n");
    if (gap != std::string_view::npos && gap >= limit / 2) kept = kept.substr(0, gap);
  }
  kept = kept.substr(0, kept.find_last_not_of(" \n") + 1);
  return std::string{kept}.append(kMore);
}

/// Fills `to` with as much of `from` as fits, always terminated.
template <std::size_t N>
void copyText(std::string_view from, char (&to)[N]) {
  const std::string_view cut = cutText(from, N - 1);
  std::memcpy(to, cut.data(), cut.size());
  to[cut.size()] = '\0';
}

/// The text of a received array, whether it is terminated or not.
template <std::size_t N>
std::string_view viewText(const char (&from)[N]) {
  return {from, static_cast<std::size_t>(std::find(from, from + N, '\0') - from)};
}

}  // namespace bleedsim::dds
