#include "service/picture/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bleedsim::picture {
namespace {

constexpr std::size_t kSteps = 4096;

float decode(int value) {
  const double v = value / 255.0;
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

std::uint8_t encode(double v) {
  const double coded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * coded));
}

// Indexed by the square root of the linear value, which is close to the sRGB curve: dark tones have as many steps as bright ones.
const std::array<std::uint8_t, kSteps + 1>& encodeTable() {
  static const auto kTable = [] {
    std::array<std::uint8_t, kSteps + 1> made{};
    for (std::size_t i = 0; i <= kSteps; ++i) {
      const double root = static_cast<double>(i) / kSteps;
      made[i] = encode(root * root);
    }
    return made;
  }();
  return kTable;
}

const std::array<float, 256>& decodeTable() {
  static const auto kTable = [] {
    std::array<float, 256> made{};
    for (std::size_t i = 0; i < made.size(); ++i) made[i] = decode(static_cast<int>(i));
    return made;
  }();
  return kTable;
}

std::uint8_t encodeChannel(float value) {
  if (!(value > 0.0F)) return 0;
  return encodeTable()[static_cast<std::size_t>(std::sqrt(std::min(value, 1.0F)) * kSteps + 0.5F)];
}

float smoothStep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

}  // namespace

LinearColor toLinear(Color color) { return {decodeTable()[color.r], decodeTable()[color.g], decodeTable()[color.b]}; }

Color toSrgb(const LinearColor& color) { return {encodeChannel(color[0]), encodeChannel(color[1]), encodeChannel(color[2])}; }

Lit lightOn(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye, const Light& light, const Material& material) {
  const Eigen::Vector3f towards = light.towards.normalized();
  const float facing = normal.dot(towards);
  Lit lit;
  // The sky is brighter than the floor.
  lit.ambient = light.ambient * (0.8F + 0.2F * normal.y());
  if (facing <= 0.0F) return lit;
  lit.diffuse = light.key * facing;
  const float half = normal.dot((towards + to_eye).normalized());
  if (half > 0.0F && material.specular > 0.0F) lit.specular = material.specular * std::pow(half, material.shininess);
  return lit;
}

float mirrored(const Eigen::Vector3f& normal, const Eigen::Vector3f& to_eye, const Light& light) {
  const float facing = std::clamp(normal.dot(to_eye), 0.0F, 1.0F);
  const Eigen::Vector3f reflected = 2.0F * normal.dot(to_eye) * normal - to_eye;
  const float to_light = reflected.dot(light.towards.normalized());
  const float room = 0.04F + 0.10F * smoothStep(-0.2F, 1.0F, reflected.y());
  const float field = 7.0F * smoothStep(0.90F, 0.97F, to_light);
  const float grazing = 1.0F - facing;
  const float grazing2 = grazing * grazing;
  const float fresnel = 0.04F + 0.96F * grazing2 * grazing2 * grazing;
  return fresnel * (room + field);
}

}  // namespace bleedsim::picture
