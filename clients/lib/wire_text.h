// Bounded strings and sequences of the wire, read and written without trusting them.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace bleedsim::client {

/// The text of a bounded string, whether or not it is terminated.
template <std::size_t N>
std::string textOf(const char (&text)[N]) {
  return {text, strnlen(text, N)};
}
/// Of an unbounded string, which is always terminated. Not an overload: it would be chosen for arrays, too.
inline std::string longTextOf(const char* text) { return text == nullptr ? std::string{} : std::string{text}; }

/// Copies and terminates; false when the text is too long or holds a zero byte, `to` is then empty.
template <std::size_t N>
bool copyText(std::string_view from, char (&to)[N]) {
  to[0] = '\0';
  if (from.size() >= N || from.find('\0') != std::string_view::npos) return false;
  std::memcpy(to, from.data(), from.size());
  to[from.size()] = '\0';
  return true;
}

/// The elements of a C sequence; empty when it has no buffer.
template <class Sequence>
auto elements(const Sequence& sequence) {
  using Element = std::remove_pointer_t<decltype(sequence._buffer)>;
  if (sequence._buffer == nullptr) return std::span<const Element>{};
  return std::span<const Element>{sequence._buffer, sequence._length};
}

}  // namespace bleedsim::client
