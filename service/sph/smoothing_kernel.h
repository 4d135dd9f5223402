// The smoothing kernels in three dimensions, in terms of the support radius h: W(r) = 0 for r >= h.
//
//   Wendland C2   W = 21/(2 pi h^3) (1-q)^4 (1+4q)                          dW/dr = -210/(pi h^4) q (1-q)^3      q = r/h
//   cubic spline  W = 8/(pi h^3) {1 - 6q^2 + 6q^3; q > 1/2: 2 (1-q)^3}
//
// Wendland 1995, Monaghan 1992. These closed forms serve tables, calibration and tests; the pair passes evaluate the same
// polynomials in units of h (passes/).
#pragma once

#include <numbers>

namespace bleedsim::sph {

enum class KernelType { wendland_c2, cubic_spline };

/// W = weight/h^3 x the polynomial, grad W = gradient/h^5 x its gradient, as passes/kernels-inl.h evaluates them; times 1/pi.
struct KernelNorms {
  double weight;
  double gradient;
};
constexpr KernelNorms kernelNorms(KernelType type) {
  return type == KernelType::cubic_spline ? KernelNorms{8.0, 48.0} : KernelNorms{10.5, 210.0};
}

struct SmoothingKernel {
  KernelType type = KernelType::wendland_c2;
  double h = 1.0;  ///< support radius, m

  /// W(r), 1/m^3.
  double value(double r) const {
    const double q = r / h;
    if (q >= 1.0) return 0.0;
    const double volume = h * h * h * std::numbers::pi;
    const double t = 1.0 - q;
    if (type == KernelType::wendland_c2) return 10.5 / volume * t * t * t * t * (1.0 + 4.0 * q);
    if (q > 0.5) return 16.0 / volume * t * t * t;
    return 8.0 / volume * (1.0 - 6.0 * q * q * t);
  }

  /// dW/dr, 1/m^4; <= 0.
  double slope(double r) const {
    const double q = r / h;
    if (q >= 1.0) return 0.0;
    const double volume = h * h * h * h * std::numbers::pi;
    const double t = 1.0 - q;
    if (type == KernelType::wendland_c2) return -210.0 / volume * q * t * t * t;
    if (q > 0.5) return -48.0 / volume * t * t;
    return 8.0 / volume * q * (18.0 * q - 12.0);
  }
};

}  // namespace bleedsim::sph
