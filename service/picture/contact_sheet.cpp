#include "service/picture/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "service/picture/overlay.h"
#include "service/picture/text.h"

namespace bleedsim::picture {
namespace {

constexpr std::size_t kMostLines = 3;
constexpr int kWidestGap = 1000;

Status invalid(const char* message) { return {StatusCode::invalid_argument, message}; }

std::string captionOf(const SheetItem& item, std::size_t index, bool lettered) {
  if (!lettered) return item.caption;
  std::string letter = "(a)";
  letter[1] = static_cast<char>('a' + index);
  return item.caption.empty() ? letter : letter + " " + item.caption;
}

void drawCentered(Image& sheet, int left, int width, int y, const std::string& text, double dot) {
  drawText(sheet, left + (width - textWidth(text, dot)) / 2, y, text, {dot, kInk});
}

}  // namespace

Result<Image> contactSheet(std::span<const SheetItem> items, const SheetStyle& style) {
  if (items.empty()) return invalid("a sheet needs at least one picture");
  if (style.lettered && items.size() > 26)
    return invalid("there are letters for 26 pictures: make several sheets, or no letters");
  if (style.columns < 0 || style.gap < 0 || style.gap > kWidestGap) {
    return invalid("a sheet's columns must be at least 0 (chosen), its gap 0 to 1000 pixels");
  }
  int cell_width = 0;
  int cell_height = 0;
  for (const SheetItem& item : items) {
    if (item.image == nullptr) return invalid("one of the sheet's pictures is missing");
    cell_width = std::max(cell_width, item.image->width());
    cell_height = std::max(cell_height, item.image->height());
  }
  const auto count = static_cast<int>(std::min<std::size_t>(items.size(), Image::kMostSide));
  const int wanted = style.columns > 0 ? style.columns : static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  const int columns = std::min(wanted, count);
  const int rows = (count + columns - 1) / columns;

  const double dot = textDotFor(cell_width) * 1.2;
  std::vector<std::vector<std::string>> captions;
  std::size_t most_lines = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    captions.push_back(wrapText(captionOf(items[i], i, style.lettered), dot, cell_width, kMostLines));
    most_lines = std::max(most_lines, captions.back().size());
  }
  const int pad = static_cast<int>(std::lround(3.0 * dot));
  const int caption_height = most_lines > 0 ? static_cast<int>(most_lines) * lineHeight(dot) + pad : 0;
  const std::int64_t width = std::int64_t{columns} * (cell_width + style.gap) + style.gap;
  const double title_dot = 1.3 * dot;
  const auto titles =
      wrapText(style.title, title_dot, static_cast<int>(std::min<std::int64_t>(width, Image::kMostSide)) - 2 * style.gap, 2);
  const int title_height = titles.empty() ? 0 : static_cast<int>(titles.size()) * lineHeight(title_dot) + pad;
  const std::int64_t height = std::int64_t{rows} * (cell_height + caption_height + style.gap) + style.gap + title_height;
  const auto side = [](std::int64_t pixels) { return static_cast<int>(std::min<std::int64_t>(pixels, Image::kMostSide + 1)); };
  Result<Image> sheet = Image::create(side(width), side(height));
  if (!sheet) return sheet;

  int y = style.gap;
  for (const std::string& line : titles) {
    drawCentered(*sheet, 0, sheet->width(), y, line, title_dot);
    y += lineHeight(title_dot);
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const int left = style.gap + static_cast<int>(i) % columns * (cell_width + style.gap);
    int top = style.gap + title_height + static_cast<int>(i) / columns * (cell_height + caption_height + style.gap);
    const Image& image = *items[i].image;
    paste(*sheet, image, left + (cell_width - image.width()) / 2, top + (cell_height - image.height()) / 2);
    top += cell_height + pad;
    for (const std::string& line : captions[i]) {
      drawCentered(*sheet, left, cell_width, top, line, dot);
      top += lineHeight(dot);
    }
  }
  return sheet;
}

}  // namespace bleedsim::picture
