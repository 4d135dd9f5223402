// Bytes of a saved state: written into room that was made beforehand, read back with every length checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace bleedsim::sph {

/// Allocates nothing. Without room it counts: used() is then what is needed.
class StateWriter {
 public:
  StateWriter() = default;
  explicit StateWriter(std::span<std::byte> room) : room_{room} {}

  template <class T>
  void value(const T& value) {
    array(&value, 1);
  }
  template <class T>
  void array(const T* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = count * sizeof(T);
    if (bytes > 0 && used_ + bytes <= room_.size()) std::memcpy(room_.data() + used_, values, bytes);
    used_ += bytes;
  }
  void text(const std::string& text) {
    value(static_cast<std::uint32_t>(text.size()));
    array(text.data(), text.size());
  }

  std::size_t used() const { return used_; }

 private:
  std::span<std::byte> room_;
  std::size_t used_ = 0;
};

/// After the first read beyond the end, failed() is true and everything reads as zero.
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : bytes_{bytes} {}

  template <class T>
  T value() {
    T out{};
    array(&out, 1);
    return out;
  }
  template <class T>
  void array(T* out, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (failed_ || count > (bytes_.size() - at_) / sizeof(T)) {
      failed_ = true;
      return;
    }
    if (count > 0) std::memcpy(out, bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  /// At most `most` bytes.
  std::string text(std::size_t most) {
    const auto size = value<std::uint32_t>();
    if (size > most || size > bytes_.size() - at_) failed_ = true;
    std::string out(failed_ ? 0 : size, '\0');
    array(out.data(), out.size());
    return out;
  }
  /// A count of things that take at least `bytes` each: more than what is left fails.
  std::uint32_t count(std::size_t most, std::size_t bytes) {
    const auto count = value<std::uint32_t>();
    if (count > most || count > (bytes_.size() - at_) / bytes) failed_ = true;
    return failed_ ? 0 : count;
  }

  bool failed() const { return failed_; }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace bleedsim::sph
