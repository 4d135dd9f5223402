// An RGB picture of 8 bits a channel, sRGB, rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "service/status/status.h"

namespace bleedsim::picture {

struct Color {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

constexpr Color kWhite{255, 255, 255};
constexpr Color kInk{34, 34, 40};  ///< of texts and frames

/// A value: copies are deep. Coordinates are pixels, (0, 0) at the top left; at() and set() need coordinates inside.
class Image {
 public:
  static constexpr int kMostSide = 16384;            ///< pixels
  static constexpr std::int64_t kMostPixels = 64e6;  ///< 192 MB

  /// invalid_argument: a side is not in 1..kMostSide, or there are more than kMostPixels.
  static Result<Image> create(int width, int height, Color fill = kWhite) {
    if (width < 1 || height < 1 || width > kMostSide || height > kMostSide || std::int64_t{width} * height > kMostPixels) {
      return Status{StatusCode::invalid_argument, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                                      " pixels is not possible: choose sides of 1 to " +
                                                      std::to_string(kMostSide) + " and at most " +
                                                      std::to_string(kMostPixels / 1000000) + " million pixels"};
    }
    return Image{width, height, fill};
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  Color at(int x, int y) const {
    const std::size_t i = index(x, y);
    return {bytes_[i], bytes_[i + 1], bytes_[i + 2]};
  }
  void set(int x, int y, Color color) {
    const std::size_t i = index(x, y);
    bytes_[i] = color.r, bytes_[i + 1] = color.g, bytes_[i + 2] = color.b;
  }

  /// Three bytes a pixel, row after row, without padding.
  std::span<const std::uint8_t> bytes() const { return bytes_; }
  std::span<std::uint8_t> bytes() { return bytes_; }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  Image(int width, int height, Color fill)
      : width_{width}, height_{height}, bytes_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    for (std::size_t i = 0; i < bytes_.size(); i += 3) bytes_[i] = fill.r, bytes_[i + 1] = fill.g, bytes_[i + 2] = fill.b;
  }
  std::size_t index(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }

  int width_;
  int height_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace bleedsim::picture
