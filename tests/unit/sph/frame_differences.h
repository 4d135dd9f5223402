// How far two frames of the same particles are apart.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "tests/support/scenes.h"

namespace bleedsim::sph {

/// Frame storage sorted by id: targets may sort particles at a cell's border differently.
inline std::vector<std::size_t> orderById(const FrameBuffer& frame) {
  std::vector<std::size_t> order(frame.count);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return frame.id[a] < frame.id[b]; });
  return order;
}

struct Differences {
  double position = 0.0;   // m
  double velocity = 0.0;   // m/s
  double density = 0.0;    // kg/m^3
  double viscosity = 0.0;  // Pa s
  double platelet = 0.0;
  double radius = 0.0;  // m
};

/// Largest difference of each field, as a part of the field's largest magnitude.
inline Differences compare(const FrameBuffer& a, const FrameBuffer& b) {
  const std::vector<std::size_t> of_a = orderById(a);
  const std::vector<std::size_t> of_b = orderById(b);
  Differences apart;
  Differences largest;
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    const std::size_t i = of_a[k];
    const std::size_t j = of_b[k];
    EXPECT_EQ(a.id[i], b.id[j]);
    apart.position = std::max(apart.position, (test::positionOf(a, i) - test::positionOf(b, j)).norm());
    apart.velocity = std::max(apart.velocity, (test::velocityOf(a, i) - test::velocityOf(b, j)).norm());
    apart.density = std::max(apart.density, std::abs(double(a.density[i]) - double(b.density[j])));
    apart.viscosity = std::max(apart.viscosity, std::abs(double(a.viscosity[i]) - double(b.viscosity[j])));
    apart.platelet = std::max(apart.platelet, std::abs(double(a.platelet[i]) - double(b.platelet[j])));
    apart.radius = std::max(apart.radius, std::abs(double(a.radius[i]) - double(b.radius[j])));
    largest.position = std::max(largest.position, test::positionOf(a, i).norm());
    largest.velocity = std::max(largest.velocity, test::velocityOf(a, i).norm());
    largest.density = std::max(largest.density, double(a.density[i]));
    largest.viscosity = std::max(largest.viscosity, double(a.viscosity[i]));
    largest.radius = std::max(largest.radius, double(a.radius[i]));
  }
  const auto part = [](double difference, double whole) { return whole > 0.0 ? difference / whole : difference; };
  return {part(apart.position, largest.position),
          part(apart.velocity, largest.velocity),
          part(apart.density, largest.density),
          part(apart.viscosity, largest.viscosity),
          apart.platelet,
          part(apart.radius, largest.radius)};
}

/// One step of two SIMD targets from the same input: 1e-5 of each field (physics.md section 8).
inline void expectAlike(const FrameBuffer& frame, const FrameBuffer& expected, std::string_view what) {
  ASSERT_EQ(frame.count, expected.count) << what;
  const Differences apart = compare(frame, expected);
  EXPECT_LT(apart.position, 1e-5) << what;
  EXPECT_LT(apart.velocity, 1e-5) << what;
  EXPECT_LT(apart.density, 1e-5) << what;
  EXPECT_LT(apart.viscosity, 1e-5) << what;
  EXPECT_LT(apart.platelet, 1e-6) << what;
  EXPECT_LT(apart.radius, 1e-5) << what;
}

}  // namespace bleedsim::sph
