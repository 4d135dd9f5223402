#include "service/picture/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "service/picture/glyphs.h"

namespace bleedsim::picture {
namespace {

constexpr int kAdvance = kGlyphColumns + 1;  // dots from one letter to the next

double dotAt(const Glyph& glyph, int column, int row) {
  if (column < 0 || row < 0 || column >= kGlyphColumns || row >= kGlyphRows) return 0.0;
  return (glyph[static_cast<std::size_t>(row)] >> (kGlyphColumns - 1 - column) & 1) != 0 ? 1.0 : 0.0;
}

/// Ink at a point of the glyph, in dots from its top left: between the middles of the dots it is interpolated and then made
/// steep, so that strokes are round and their edges one pixel soft.
double inkAt(const Glyph& glyph, double x, double y, double dot) {
  const double fx = x - 0.5;
  const double fy = y - 0.5;
  const int column = static_cast<int>(std::floor(fx));
  const int row = static_cast<int>(std::floor(fy));
  const double u = fx - column;
  const double v = fy - row;
  const double upper = (1.0 - u) * dotAt(glyph, column, row) + u * dotAt(glyph, column + 1, row);
  const double lower = (1.0 - u) * dotAt(glyph, column, row + 1) + u * dotAt(glyph, column + 1, row + 1);
  const double density = (1.0 - v) * upper + v * lower;
  // A stroke's edge lies where half of the ink is; the threshold below one half makes strokes about one dot wide.
  return std::clamp((density - 0.42) * std::max(dot, 1.0) * 1.2 + 0.5, 0.0, 1.0);
}

std::uint8_t mix(std::uint8_t below, std::uint8_t above, double alpha) {
  return static_cast<std::uint8_t>(std::lround(below + alpha * (above - below)));
}

void blend(Image& image, int x, int y, Color color, double alpha) {
  if (alpha <= 0.0 || !image.contains(x, y)) return;
  const Color old = image.at(x, y);
  const double a = std::min(alpha, 1.0);
  image.set(x, y, {mix(old.r, color.r, a), mix(old.g, color.g, a), mix(old.b, color.b, a)});
}

/// Ends in "..." where it is too long or text was `left_out` behind it.
std::string cutText(std::string text, double dot, int width, bool left_out) {
  if (!left_out && textWidth(text, dot) <= width) return text;
  while (!text.empty() && textWidth(text + "...", dot) > width) text.pop_back();
  return text + "...";
}

int pixels(double dots, double dot) { return static_cast<int>(std::ceil(dots * dot)); }

}  // namespace

int textWidth(std::string_view text, double dot) {
  if (text.empty()) return 0;
  return pixels(static_cast<double>(text.size()) * kAdvance - 1.0, dot);
}

int textHeight(double dot) { return pixels(kGlyphRows + kMostDrop, dot); }

int lineHeight(double dot) { return pixels(kGlyphRows + kMostDrop + 2, dot); }

void drawText(Image& image, int x, int y, std::string_view text, const TextStyle& style) {
  const int columns = pixels(kGlyphColumns, style.dot);
  const int rows = pixels(kGlyphRows, style.dot);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Glyph& glyph = glyphOf(text[i]);
    const double left = static_cast<double>(i) * kAdvance * style.dot;
    const int start = static_cast<int>(std::floor(left));
    const int top = y + static_cast<int>(std::lround(dropOf(text[i]) * style.dot));
    for (int dy = -1; dy <= rows; ++dy) {
      for (int dx = -1; dx <= columns + 1; ++dx) {
        const double ink = inkAt(glyph, (start + dx + 0.5 - left) / style.dot, (dy + 0.5) / style.dot, style.dot);
        blend(image, x + start + dx, top + dy, style.color, ink);
      }
    }
  }
}

std::vector<std::string> wrapText(std::string_view text, double dot, int width, std::size_t most) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = text.find_first_not_of(' ', at);
    if (start == std::string_view::npos) break;
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string_view word = text.substr(start, end - start);
    at = end;
    const std::string longer = line.empty() ? std::string{word} : line + " " + std::string{word};
    if (line.empty() || textWidth(longer, dot) <= width) {
      line = longer;
      continue;
    }
    lines.push_back(std::move(line));
    line = std::string{word};
  }
  if (!line.empty()) lines.push_back(std::move(line));
  const bool more = lines.size() > most;
  if (more) lines.resize(most);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = cutText(std::move(lines[i]), dot, width, more && i + 1 == most);
  return lines;
}

std::string shortNumber(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

void fillRectangle(Image& image, int x, int y, int width, int height, Color color, double alpha) {
  for (int row = std::max(y, 0); row < std::min(y + height, image.height()); ++row) {
    for (int column = std::max(x, 0); column < std::min(x + width, image.width()); ++column) {
      blend(image, column, row, color, alpha);
    }
  }
}

void paste(Image& image, const Image& source, int x, int y) {
  for (int row = 0; row < source.height(); ++row) {
    for (int column = 0; column < source.width(); ++column) {
      if (image.contains(x + column, y + row)) image.set(x + column, y + row, source.at(column, row));
    }
  }
}

}  // namespace bleedsim::picture
