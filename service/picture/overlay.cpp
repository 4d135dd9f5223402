#include "service/picture/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "service/picture/text.h"

namespace bleedsim::picture {
namespace {

constexpr Color kBand{20, 20, 24};
constexpr double kBandAlpha = 0.62;

struct Unit {
  double metres;
  std::string_view name;
};
constexpr std::array<Unit, 5> kUnits{{{1e3, "km"}, {1.0, "m"}, {1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}}};

}  // namespace

double textDotFor(int width) { return std::clamp(width / 420.0, 1.0, 6.0); }

void drawCaption(Image& image, std::string_view text) {
  if (text.empty()) return;
  const double dot = textDotFor(image.width());
  const int margin = static_cast<int>(std::lround(4.0 * dot));
  const std::vector<std::string> lines = wrapText(text, dot, std::max(1, image.width() - 2 * margin), 2);
  const int height = static_cast<int>(lines.size()) * lineHeight(dot) + 2 * margin - static_cast<int>(2.0 * dot);
  fillRectangle(image, 0, 0, image.width(), height, kBand, kBandAlpha);
  int y = margin;
  for (const std::string& line : lines) {
    drawText(image, margin, y, line, {dot, kWhite});
    y += lineHeight(dot);
  }
}

ScaleLength roundLength(double most_m) {
  const double power = std::pow(10.0, std::floor(std::log10(most_m) + 1e-9));
  const double lead = most_m / power * (1.0 + 1e-9);
  ScaleLength scale{power * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0), {}};
  const auto unit = std::find_if(kUnits.begin(), kUnits.end() - 1,
                                 [&scale](const Unit& one) { return scale.length_m >= one.metres * (1.0 - 1e-9); });
  scale.text = shortNumber(scale.length_m / unit->metres) + " " + std::string{unit->name};
  return scale;
}

void drawScaleBar(Image& image, double pixels_per_m) {
  const double dot = textDotFor(image.width());
  const ScaleLength scale = roundLength(0.25 * image.width() / pixels_per_m);
  const int length = static_cast<int>(std::lround(scale.length_m * pixels_per_m));
  const int margin = static_cast<int>(std::lround(8.0 * dot));
  const int pad = static_cast<int>(std::lround(4.0 * dot));
  const int bar = std::max(2, static_cast<int>(std::lround(2.0 * dot)));
  const int text_width = textWidth(scale.text, dot);
  const int box_width = std::max(length, text_width) + 2 * pad;
  const int box_height = textHeight(dot) + bar + 2 * pad + pad / 2;
  const int left = margin;
  const int top = image.height() - margin - box_height;
  fillRectangle(image, left, top, box_width, box_height, kBand, kBandAlpha);
  drawText(image, left + (box_width - text_width) / 2, top + pad, scale.text, {dot, kWhite});
  const int bar_left = left + (box_width - length) / 2;
  const int bar_top = top + box_height - pad - bar;
  fillRectangle(image, bar_left, bar_top, length, bar, kWhite);
  // Ticks at both ends: they say where exactly the length is measured.
  fillRectangle(image, bar_left, bar_top - bar, bar / 2 + 1, 2 * bar, kWhite);
  fillRectangle(image, bar_left + length - bar / 2 - 1, bar_top - bar, bar / 2 + 1, 2 * bar, kWhite);
}

void drawColorBar(Image& image, const Range& range, std::string_view name) {
  const double dot = textDotFor(image.width());
  const int pad = static_cast<int>(std::lround(4.0 * dot));
  const int margin = static_cast<int>(std::lround(8.0 * dot));
  const int bar_width = static_cast<int>(std::lround(9.0 * dot));
  const int bar_height = image.height() * 2 / 5;
  constexpr int kTicks = 5;
  std::array<std::string, kTicks> numbers;
  int text_width = 0;
  for (int i = 0; i < kTicks; ++i) {
    numbers[static_cast<std::size_t>(i)] = shortNumber(range.lower + (range.upper - range.lower) * i / (kTicks - 1));
    text_width = std::max(text_width, textWidth(numbers[static_cast<std::size_t>(i)], dot));
  }
  const std::vector<std::string> names = wrapText(name, dot, image.width() / 3, 2);
  int name_width = 0;
  for (const std::string& line : names) name_width = std::max(name_width, textWidth(line, dot));
  const int inner = std::max(bar_width + pad + text_width, name_width);
  const int names_height = static_cast<int>(names.size()) * lineHeight(dot);
  const int box_width = inner + 2 * pad;
  const int box_height = bar_height + names_height + textHeight(dot) + 2 * pad;
  const int left = image.width() - margin - box_width;
  const int top = (image.height() - box_height) / 2;
  fillRectangle(image, left, top, box_width, box_height, kBand, kBandAlpha);
  int y = top + pad;
  for (const std::string& line : names) {
    drawText(image, left + pad, y, line, {dot, kWhite});
    y += lineHeight(dot);
  }
  y += static_cast<int>(3.5 * dot);
  for (int row = 0; row < bar_height; ++row) {
    fillRectangle(image, left + pad, y + row, bar_width, 1, mapColor(1.0 - row / std::max(1.0, bar_height - 1.0)));
  }
  for (int i = 0; i < kTicks; ++i) {
    const int tick = y + (bar_height - 1) * (kTicks - 1 - i) / (kTicks - 1);
    fillRectangle(image, left + pad + bar_width, tick, pad / 2 + 1, 1, kWhite);
    drawText(image, left + 2 * pad + bar_width, tick - static_cast<int>(3.5 * dot), numbers[static_cast<std::size_t>(i)],
             {dot, kWhite});
  }
}

}  // namespace bleedsim::picture
