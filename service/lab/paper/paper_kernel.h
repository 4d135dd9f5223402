// The paper's kernels in space, q = r/h: (29) poly6, (30) spiky, (32) viscosity.
#pragma once

#include <cmath>
#include <numbers>

namespace bleedsim::lab {

struct PaperKernel {
  enum class Type { poly6, spiky, viscosity };
  Type type = Type::poly6;
  double h = 1.0;  ///< support radius

  double value(double r) const {
    const double q = r / h;
    const double t = 1.0 - q;
    if (t <= 0.0) return 0.0;
    const double norm = 1.0 / (std::numbers::pi * h * h * h);
    switch (type) {
      case Type::poly6:
        return 315.0 / 64.0 * norm * std::pow(1.0 - q * q, 3);
      case Type::spiky:
        return 15.0 * norm * t * t * t;
      case Type::viscosity:
        break;
    }
    return 7.5 * norm * (-0.5 * q * q * q + q * q + 0.5 / q - 1.0);
  }
  /// dW/dr, with the sign of (31) mended.
  double slope(double r) const {
    const double q = r / h;
    const double t = 1.0 - q;
    if (t <= 0.0) return 0.0;
    const double norm = 1.0 / (std::numbers::pi * h * h * h * h);
    switch (type) {
      case Type::poly6:
        return -945.0 / 32.0 * norm * q * (1.0 - q * q) * (1.0 - q * q);
      case Type::spiky:
        return -45.0 * norm * t * t;
      case Type::viscosity:
        break;
    }
    return 7.5 * norm * (-1.5 * q * q + 2.0 * q - 0.5 / (q * q));
  }
  /// lap W; r > 0.
  double laplacian(double r) const {
    const double q = r / h;
    const double t = 1.0 - q;
    if (t <= 0.0) return 0.0;
    const double norm = 1.0 / (std::numbers::pi * h * h * h * h * h);
    switch (type) {
      case Type::poly6:
        return 945.0 / 32.0 * norm * (1.0 - q * q) * (7.0 * q * q - 3.0);
      case Type::spiky:
        return 90.0 * norm * t * (2.0 - 1.0 / q);
      case Type::viscosity:
        break;
    }
    return 45.0 * norm * t;
  }
};

}  // namespace bleedsim::lab
