#include "service/picture/scene_picture.h"

#include <algorithm>
#include <cmath>

#include "service/picture/ground.h"
#include "service/picture/occlusion.h"
#include "service/picture/overlay.h"
#include "service/picture/smooth_surface.h"

namespace bleedsim::picture {
namespace {

constexpr int kMostSamples = 4;

// The liquid, in radii of its particles. Spheres of 1.5 radii close the gaps of a lattice of neighbours that touch; they hold
// 1.5^3 times the volume, which the thickness is freed from.
constexpr double kLiquidRadius = 1.5;
constexpr double kLiquidSigma = 1.3;
constexpr double kLiquidRange = 3.0;
// In these thicknesses light falls to 1/e. Red goes farther than green and blue: thin blood is red, deep blood nearly black.
constexpr float kRedLength = 2.2F;
constexpr float kOtherLength = 0.32F;

constexpr float kDeepShade = 0.45F;  // of deep blood, to a thin layer of it

constexpr Material kSphereMaterial{0.28F, 36.0F};
constexpr Material kLiquidMaterial{0.55F, 160.0F};
constexpr Material kTissueMaterial{0.0F, 1.0F};

Status invalid(const std::string& message) { return {StatusCode::invalid_argument, message}; }

Status checkStyle(const SceneStyle& style) {
  if (style.samples < 1 || style.samples > kMostSamples) {
    return invalid("samples is " + std::to_string(style.samples) + ": choose 1 to " + std::to_string(kMostSamples));
  }
  if (style.values &&
      !(std::isfinite(style.values->lower) && std::isfinite(style.values->upper) && style.values->lower < style.values->upper)) {
    return invalid("the range of the colours must be finite, its lower end below its upper one");
  }
  if (!style.light.towards.allFinite() || !(style.light.towards.norm() > 0.0F)) {
    return invalid("the direction of the light must be finite and have a length");
  }
  return {};
}

/// Of all that can be drawn, m; 1 if there are none.
double meanRadius(const ParticleCloud& cloud) {
  if (cloud.radii.empty()) return cloud.radius_m > 0.0 ? cloud.radius_m : 1.0;
  double sum = 0.0;
  std::size_t count = 0;
  for (const float radius : cloud.radii) {
    if (!(radius > 0.0F) || !std::isfinite(radius)) continue;
    sum += static_cast<double>(radius);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

/// Everything that the colour of a sample needs.
class Painter {
 public:
  Painter(const View& view, const ParticleCloud& cloud, const SceneStyle& style, const Range& range, const Splats& splats,
          const Ground& ground)
      : view_{view},
        cloud_{cloud},
        style_{style},
        range_{range},
        splats_{splats},
        ground_{ground},
        radius_{static_cast<float>(meanRadius(cloud))},
        blood_{toLinear(style.blood)} {
    const std::size_t pixels = ground.surface.depth.size();
    depth_.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) depth_[i] = std::min(ground.surface.depth[i], splats.surface.depth[i]);
    const double reach = 2.5 * static_cast<double>(radius_) * view.pixelsPerMetre(view.targetDepth());
    occlusion_ = occlusionOf(depth_, view.width(), view.height(), 1.2 * static_cast<double>(radius_), std::max(reach, 3.0));
  }

  const std::vector<float>& depth() const { return depth_; }

  LinearColor colorAt(int x, int y) const {
    const std::size_t i = ground_.surface.index(x, y);
    const bool blood = splats_.surface.depth[i] < ground_.surface.depth[i];
    const bool has_tissue = ground_.surface.has(i);
    if (!blood && !has_tissue) return ground_.albedo[i];
    const Eigen::Vector3f to_eye = toEye(x, y);
    if (!blood) return groundColor(i, to_eye);
    if (style_.look == BloodLook::liquid) return liquidColor(i, to_eye);
    return surfaceColor(albedoOf(i), splats_.surface.normal[i], to_eye, kSphereMaterial, occlusion_[i]);
  }

 private:
  Eigen::Vector3f toEye(int x, int y) const {
    if (!view_.perspective()) return {0.0F, 0.0F, -1.0F};
    return -view_.fromPixel(x + 0.5, y + 0.5, 1.0).normalized().cast<float>();
  }

  LinearColor surfaceColor(const LinearColor& albedo, const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye,
                           const Material& material, float occlusion) const {
    const Lit lit = lightOn(normal, to_eye, style_.light, material);
    const float open = 1.0F - 0.65F * occlusion;
    return albedo * (lit.ambient * open + lit.diffuse * (0.45F + 0.55F * open)) * 1.1F +
           LinearColor::Constant(lit.specular * open);
  }

  LinearColor groundColor(std::size_t i, const Eigen::Vector3f& to_eye) const {
    if (!ground_.surface.has(i)) return ground_.albedo[i];
    return surfaceColor(ground_.albedo[i], ground_.surface.normal[i], to_eye, kTissueMaterial, occlusion_[i]);
  }

  /// Of a sphere's surface, or of the mixture that the ray meets in the liquid.
  LinearColor albedoOf(std::size_t i) const {
    if (cloud_.values.empty()) return blood_;
    const float value = splats_.value.empty() ? cloud_.values[splats_.particle[i]] : splats_.value[i];
    return toLinear(mapColor(range_.share(static_cast<double>(value))));
  }

  LinearColor liquidColor(std::size_t i, const Eigen::Vector3f& to_eye) const {
    const Eigen::Vector3f& normal = splats_.surface.normal[i];
    const Lit lit = lightOn(normal, to_eye, style_.light, kLiquidMaterial);
    const float open = 1.0F - 0.6F * occlusion_[i];
    const float thickness = splats_.thickness[i] / radius_;
    LinearColor passed{std::exp(-thickness / kRedLength), std::exp(-thickness / kOtherLength),
                       std::exp(-thickness / kOtherLength)};
    // Coloured by values it must not show the tissue's colour, nor darken with depth.
    if (!cloud_.values.empty()) passed = LinearColor::Constant(std::exp(-4.0F * thickness));
    LinearColor own = albedoOf(i);
    if (cloud_.values.empty()) own *= kDeepShade + (1.0F - kDeepShade) * std::exp(-0.3F * thickness);
    const LinearColor scattered = own * (lit.ambient * open + lit.diffuse);
    // The rim of a thin layer is rounder than blood's: without this it would glitter.
    const float body = 1.0F - std::exp(-2.0F * thickness);
    const float glint = body * body * (lit.specular + mirrored(normal, to_eye, style_.light)) * open;
    return groundColor(i, to_eye) * passed + scattered * (1.0F - passed) + LinearColor::Constant(glint);
  }

  const View& view_;
  const ParticleCloud& cloud_;
  const SceneStyle& style_;
  const Range& range_;
  const Splats& splats_;
  const Ground& ground_;
  float radius_;  ///< mean, m
  LinearColor blood_;
  std::vector<float> depth_;
  std::vector<float> occlusion_;
};

Splats splatBlood(const View& view, const ParticleCloud& cloud, BloodLook look) {
  if (look == BloodLook::spheres) return splatSpheres(view, cloud, {});
  Splats splats = splatSpheres(view, cloud, {kLiquidRadius, true});
  const double radius = meanRadius(cloud);
  smoothQuantity(view, radius, splats.surface, splats.thickness);
  constexpr auto kShare = static_cast<float>(1.0 / (kLiquidRadius * kLiquidRadius * kLiquidRadius));
  for (float& thickness : splats.thickness) thickness *= kShare;
  smoothSurface(view, {kLiquidSigma * radius, kLiquidRange * radius, 3}, splats.surface);
  return splats;
}

/// Takes the mean of each pixel's samples.
void resolve(const Painter& painter, const SceneStyle& style, ScenePicture& picture) {
  const int n = style.samples;
  const float share = 1.0F / static_cast<float>(n * n);
  const std::vector<float>& depth = painter.depth();
  for (int y = 0; y < style.height; ++y) {
    for (int x = 0; x < style.width; ++x) {
      LinearColor sum = LinearColor::Zero();
      float nearest = kNoDepth;
      for (int sy = y * n; sy < (y + 1) * n; ++sy) {
        for (int sx = x * n; sx < (x + 1) * n; ++sx) {
          // Bounded before the mean: a glint brighter than the screen must not spread over a whole pixel.
          sum += painter.colorAt(sx, sy).min(1.0F);
          nearest = std::min(
              nearest,
              depth[static_cast<std::size_t>(sy) * static_cast<std::size_t>(style.width * n) + static_cast<std::size_t>(sx)]);
        }
      }
      picture.image.set(x, y, toSrgb(sum * share));
      picture.depth_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(style.width) + static_cast<std::size_t>(x)] =
          nearest;
    }
  }
}

}  // namespace

Result<ScenePicture> drawScene(const ParticleCloud& cloud, const std::vector<Shape>& tissue, const Camera& camera,
                               const SceneStyle& style) {
  if (const Status status = checkStyle(style); !status.ok()) return status;
  if (const Status status = checkCloud(cloud); !status.ok()) return status;
  for (const Shape& shape : tissue) {
    if (const Status status = checkShape(shape); !status.ok()) return status;
  }
  Result<Image> image = Image::create(style.width, style.height);
  if (!image) return image.status();
  const std::int64_t pixels = std::int64_t{style.width} * style.height;
  if (pixels * style.samples * style.samples > Image::kMostPixels) {
    return invalid("the picture has too many pixels for " + std::to_string(style.samples) +
                   " samples an axis: choose fewer samples or a smaller picture");
  }
  Result<View> view = View::create(camera, style.width * style.samples, style.height * style.samples);
  if (!view) return view.status();

  const double pixels_per_m = view->pixelsPerMetre(view->targetDepth()) / style.samples;
  const GroundStyle ground_style{style.tissue, style.background, style.grid, gridPitch(pixels_per_m)};
  const Splats splats = splatBlood(*view, cloud, style.look);
  const Ground ground = castGround(*view, tissue, ground_style);
  const Range range = style.values ? *style.values : rangeOf(cloud.values).value_or(Range{});
  const Painter painter{*view, cloud, style, range, splats, ground};

  ScenePicture picture{std::move(*image), std::vector<float>(static_cast<std::size_t>(pixels)), splats.counts};
  resolve(painter, style, picture);
  if (style.scale_bar) drawScaleBar(picture.image, pixels_per_m);
  if (!cloud.values.empty()) drawColorBar(picture.image, range, style.value_name);
  drawCaption(picture.image, style.caption);
  return picture;
}

}  // namespace bleedsim::picture
