// Pictures of recorded frames, all of a recording from the same place and in the same colours. No command line in here.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/picture/scene_picture.h"
#include "service/recording/recording_reader.h"

namespace bleedsim::bleedctl {

struct PaintOptions {
  int width = 960;   ///< pixels
  int height = 720;  ///< pixels
  picture::NamedView view = picture::NamedView::oblique;
  picture::BloodLook look = picture::BloodLook::liquid;
  std::string color_by;  ///< speed, or an attribute of one number; empty: as blood
};

class FramePainter {
 public:
  using Progress = std::function<bool(std::size_t done, std::size_t total)>;

  /// Reads the scenes, and the frames to find what the pictures have to show; `progress` false gives up (wrong_state).
  /// Errors: as the reader's; invalid_argument: the camera, or a frame without what is to be shown in colours.
  static Result<FramePainter> create(recording::RecordingReader& reader, const std::vector<std::size_t>& frames,
                                     const PaintOptions& options, const Progress& progress = {});

  /// invalid_argument: the size of the picture.
  Result<picture::Image> paint(recording::RecordingReader& reader, std::size_t frame);

  /// What the pictures lack, for people; empty: nothing.
  const std::string& warning() const { return warning_; }

 private:
  using Epoch = std::pair<std::string, std::uint32_t>;
  struct Place {
    std::vector<picture::Shape> tissue;
    picture::Bounds domain;  ///< m
    double spacing_m = 0.0;
  };

  explicit FramePainter(const PaintOptions& options) : options_{options} {}
  Status readScenes(recording::RecordingReader& reader);
  Status measure(recording::RecordingReader& reader, const std::vector<std::size_t>& frames, const Progress& progress);
  Status load(recording::RecordingReader& reader, std::size_t frame);
  Status loadValues();
  Status aim();
  const Place* placeOf(const recording::Frame& frame) const;

  PaintOptions options_;
  std::map<Epoch, Place> places_;
  std::optional<picture::Bounds> shown_;  ///< around all blood, m
  std::optional<picture::Range> values_;
  double spacing_m_ = 0.0;  ///< the largest
  picture::Camera camera_;
  std::string warning_;
  // Of the frame that is loaded.
  recording::Frame frame_;
  std::vector<float> positions_;
  std::vector<float> colors_;
};

}  // namespace bleedsim::bleedctl
