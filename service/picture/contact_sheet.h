// Several pictures in a grid with captions, as in a paper's figure (a) to (f).
#pragma once

#include <span>
#include <string>

#include "service/picture/image.h"
#include "service/status/status.h"

namespace bleedsim::picture {

struct SheetItem {
  const Image* image = nullptr;  ///< of the caller, not null
  std::string caption;
};

struct SheetStyle {
  int columns = 0;       ///< 0: about as many as rows
  int gap = 12;          ///< pixels around and between the pictures
  bool lettered = true;  ///< captions start with (a), (b), ...
  std::string title{};   ///< over all of them; empty: none
};

/// Cells have the size of the largest picture; smaller ones stand in their middle. Every caption has up to three lines.
/// invalid_argument: no pictures, more than 26 lettered ones, bad columns or gap, or the sheet is larger than an Image may be.
Result<Image> contactSheet(std::span<const SheetItem> items, const SheetStyle& style = {});

}  // namespace bleedsim::picture
