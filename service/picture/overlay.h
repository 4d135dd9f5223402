// What stands on top of a picture: caption, scale bar and colour bar.
#pragma once

#include <string>
#include <string_view>

#include "service/picture/color_map.h"
#include "service/picture/image.h"

namespace bleedsim::picture {

/// Pixels of a letter's dot that suit a picture of this width.
double textDotFor(int width);

/// A dark band along the upper edge with the text in white, in up to two lines.
void drawCaption(Image& image, std::string_view text);

struct ScaleLength {
  double length_m = 0.0;  ///< 1, 2 or 5 times a power of ten
  std::string text;       ///< e.g. "5 mm"
};

/// The longest round length of at most `most_m`, from nanometres to kilometres; most_m > 0.
ScaleLength roundLength(double most_m);

/// At the lower left, at most a quarter of the width long. `pixels_per_m` > 0.
void drawScaleBar(Image& image, double pixels_per_m);

/// At the right: least value below, greatest above, name over it.
void drawColorBar(Image& image, const Range& range, std::string_view name);

}  // namespace bleedsim::picture
