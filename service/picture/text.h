// Texts in pictures, in a small font of our own: smooth at any size, ASCII only, other bytes are drawn as '?'.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "service/picture/image.h"

namespace bleedsim::picture {

/// The height of a capital letter is seven dots.
struct TextStyle {
  double dot = 2.0;  ///< pixels a dot
  Color color = kInk;
};

/// Pixels from the first to the last column of ink; 0 for an empty text.
int textWidth(std::string_view text, double dot);
/// Pixels from the top of a capital letter to the lowest point of a 'g'.
int textHeight(double dot);
/// Pixels from one line to the next.
int lineHeight(double dot);

/// Top left of a capital letter at (x, y); what lies outside the picture is left out.
void drawText(Image& image, int x, int y, std::string_view text, const TextStyle& style);

/// Broken at blanks into at most `most` lines of at most `width` pixels; what does not fit is replaced by "...".
std::vector<std::string> wrapText(std::string_view text, double dot, int width, std::size_t most);

/// At most four significant digits: 0.00251 -> "0.00251", 1e9 -> "1e+09".
std::string shortNumber(double value);

/// alpha 0 leaves the picture, 1 covers it.
void fillRectangle(Image& image, int x, int y, int width, int height, Color color, double alpha = 1.0);
/// Puts `source` with its top left at (x, y); what lies outside is left out.
void paste(Image& image, const Image& source, int x, int y);

}  // namespace bleedsim::picture
