#include "clients/bleedctl/frame_painter.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "clients/bleedctl/tissue_shapes.h"
#include "service/recording/frame_layout.h"
#include "service/recording/scene_text.h"

namespace bleedsim::bleedctl {
namespace {

using recording::Attribute;
using recording::AttributeBlock;

constexpr double kDrawnRadius = 0.6;  // spacings: neighbours at rest overlap a little
constexpr double kMargin = 3.0;       // spacings around the blood

struct ColorRow {
  const char* name;
  Attribute::Semantic semantic;
  const char* unit;
};
constexpr std::array<ColorRow, 5> kColors{{{"speed", Attribute::VELOCITY, "m/s"},
                                           {"radius", Attribute::RADIUS, "m"},
                                           {"platelet", Attribute::PLATELET, ""},
                                           {"viscosity", Attribute::VISCOSITY, "Pa s"},
                                           {"density", Attribute::DENSITY, "kg/m3"}}};

const ColorRow* colorOf(const std::string& name) {
  const auto row = std::find_if(kColors.begin(), kColors.end(), [&](const ColorRow& each) { return each.name == name; });
  return row == kColors.end() ? nullptr : row;
}

/// What the frame could be coloured by.
std::string colorsOf(const std::vector<AttributeBlock>& blocks) {
  std::string names;
  for (const ColorRow& row : kColors) {
    if (recording::findBlock(blocks, row.semantic) != nullptr) names += (names.empty() ? "" : ", ") + std::string{row.name};
  }
  return names.empty() ? "nothing" : names;
}

template <class Box>
void extend(std::optional<Box>& all, const Box& one) {
  if (!all) all = one;
  all->lower = all->lower.cwiseMin(one.lower);
  all->upper = all->upper.cwiseMax(one.upper);
}

picture::Vec3 toVec3(const recording::Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Status FramePainter::readScenes(recording::RecordingReader& reader) {
  reader.select({recording::Topic::scene});
  for (;;) {
    recording::RecordedMessage message;
    const Result<bool> more = reader.next(message);
    if (!more) return more.status();
    if (!*more) return {};
    recording::Scene scene;
    if (Status status = recording::decode(message, scene); !status) return status;
    Place& place = places_[{scene.session(), scene.epoch()}];
    place.domain = {toVec3(scene.lower_bound()), toVec3(scene.upper_bound())};
    place.spacing_m = scene.spacing_m();
    spacing_m_ = std::max(spacing_m_, place.spacing_m);
    if (const Result<scene::Scene> text = recording::readSceneText(scene.scene_text())) {
      place.tissue = tissueShapes(*text);
    } else {
      warning_ = text.status().message() + "; the pictures are without tissue";
    }
  }
}

const FramePainter::Place* FramePainter::placeOf(const recording::Frame& frame) const {
  const auto place = places_.find({frame.session(), frame.epoch()});
  return place == places_.end() ? nullptr : &place->second;
}

Status FramePainter::loadValues() {
  colors_.clear();
  if (options_.color_by.empty()) return {};
  const Result<std::vector<AttributeBlock>> blocks = recording::layoutOf(frame_);
  if (!blocks) return blocks.status();
  const ColorRow* row = colorOf(options_.color_by);
  const AttributeBlock* block = row == nullptr ? nullptr : recording::findBlock(*blocks, row->semantic);
  if (block == nullptr) {
    return {StatusCode::invalid_argument, fmt::format("the blood at {:.3f} s cannot be coloured by '{:.32}': there is {}",
                                                      frame_.sim_time_s(), options_.color_by, colorsOf(*blocks))};
  }
  std::vector<float> values;
  recording::readFloats(*block, values);
  if (row->semantic == Attribute::VELOCITY) {
    recording::vectorLengths(values, block->attribute->components(), colors_);
  } else {
    colors_ = std::move(values);
  }
  return {};
}

Status FramePainter::load(recording::RecordingReader& reader, std::size_t frame) {
  if (Status status = reader.frame(frame, frame_); !status) return status;
  const Result<std::vector<AttributeBlock>> blocks = recording::layoutOf(frame_);
  if (!blocks) return blocks.status();
  recording::readFloats(*recording::findBlock(*blocks, Attribute::POSITION), positions_);
  return loadValues();
}

Status FramePainter::measure(recording::RecordingReader& reader, const std::vector<std::size_t>& frames,
                             const Progress& progress) {
  std::optional<picture::Bounds> domain;
  std::size_t done = 0;
  for (const std::size_t number : frames) {
    if (Status status = load(reader, number); !status) return status;
    if (const auto bounds = picture::boundsOf(positions_, 0.0)) extend(shown_, *bounds);
    if (const auto range = picture::rangeOf(colors_)) {
      if (!values_) values_ = range;
      values_->lower = std::min(values_->lower, range->lower);
      values_->upper = std::max(values_->upper, range->upper);
    }
    if (const Place* place = placeOf(frame_)) extend(domain, place->domain);
    if (progress && !progress(++done, frames.size())) return {StatusCode::wrong_state, "interrupted"};
  }
  // Before the first drop there is only the place to show.
  if (!shown_) shown_ = domain;
  return {};
}

Status FramePainter::aim() {
  if (!shown_) return {StatusCode::not_found, "there is nothing to draw: no blood, and no scene in the recording"};
  if (!(spacing_m_ > 0.0)) {
    // Of scattered points; there is no better scale.
    spacing_m_ = std::max(0.01 * (shown_->upper - shown_->lower).norm(), 1e-6);
    warning_ = "the recording holds no scene: the pictures are without tissue, and the size of the particles is a guess";
  }
  picture::Bounds box = *shown_;
  box.lower.array() -= kMargin * spacing_m_;
  box.upper.array() += kMargin * spacing_m_;
  picture::FitOptions fit;
  fit.aspect = static_cast<double>(options_.width) / options_.height;
  const Result<picture::Camera> camera = picture::fitCamera(box, options_.view, fit);
  if (!camera) return camera.status();
  camera_ = *camera;
  return {};
}

Result<FramePainter> FramePainter::create(recording::RecordingReader& reader, const std::vector<std::size_t>& frames,
                                          const PaintOptions& options, const Progress& progress) {
  FramePainter painter{options};
  if (Status status = painter.readScenes(reader); !status) return status;
  if (Status status = painter.measure(reader, frames, progress); !status) return status;
  if (Status status = painter.aim(); !status) return status;
  return painter;
}

Result<picture::Image> FramePainter::paint(recording::RecordingReader& reader, std::size_t frame) {
  if (Status status = load(reader, frame); !status) return status;
  const Place* place = placeOf(frame_);
  picture::SceneStyle style;
  style.width = options_.width;
  style.height = options_.height;
  style.look = options_.look;
  style.caption = fmt::format("{:.3f} s, {} particles", frame_.sim_time_s(), frame_.count());
  style.values = values_;
  if (const ColorRow* row = colorOf(options_.color_by)) style.value_name = fmt::format("{} {}", row->name, row->unit);
  picture::ParticleCloud cloud;
  cloud.positions = positions_;
  cloud.values = colors_;
  cloud.radius_m = kDrawnRadius * (place != nullptr && place->spacing_m > 0.0 ? place->spacing_m : spacing_m_);
  Result<picture::ScenePicture> drawn =
      picture::drawScene(cloud, place != nullptr ? place->tissue : std::vector<picture::Shape>{}, camera_, style);
  if (!drawn) return drawn.status();
  return std::move(drawn->image);
}

}  // namespace bleedsim::bleedctl
