// The smoothing kernels in terms of the support radius h: W(r) = 0 for r >= h; q = r/h.
//
//                    in space                                 in the plane
//   Wendland C2      21/(2 pi h^3) (1-q)^4 (1+4q)             7/(pi h^2) the same
//   cubic spline     8/(pi h^3) {1 - 6q^2 + 6q^3; q > 1/2: 2 (1-q)^3}         40/(7 pi h^2) the same
//   poly6 (29)       315/(64 pi h^3) (1-q^2)^3                4/(pi h^2) the same
//   spiky (30)       15/(pi h^3) (1-q)^3                      10/(pi h^2) the same
//   viscosity (32)   15/(2 pi h^3) (-q^3/2 + q^2 + 1/(2q) - 1)                40/(pi h^2) (q^2/4 - q^3/9 - ln(q)/6 - 5/36)
//
// Wendland 1995, Monaghan 1992, the paper (Mueller 2003). (31) is printed with the sign that makes dW/dr positive; here dW/dr =
// -45/(pi h^6) (h-r)^2. What (32) is made for is its Laplacian (33), 45/(pi h^6) (h-r), linear and never negative. Its polynomial
// has a Laplacian ~ 1/q^3 in the plane; the kernel of the plane that keeps the property, 40/(pi h^5) (h-r), is the one above.
//
// A world of one layer (WorldDescription::planar) divides the plane's kernels by the layer's thickness, so that they too are in
// 1/m^3 and densities in kg/m^3. These closed forms serve tables, calibration and tests; the pair passes evaluate the same
// functions in units of h (passes/).
#pragma once

#include <cmath>
#include <numbers>

namespace bleedsim::sph {

/// poly6, spiky and viscosity are the literal model's.
enum class KernelType { wendland_c2, cubic_spline, poly6, spiky, viscosity };

/// W = weight/h^d f(q) with f as above, times 1/pi; grad W = gradient/h^(d+2) x the gradient as passes/kernels-inl.h and
/// paper_kernels-inl.h evaluate it, times 1/pi; d = 3, or 2 in the plane.
struct KernelNorms {
  double weight;
  double gradient;
};
constexpr KernelNorms kernelNorms(KernelType type, bool planar = false) {
  switch (type) {
    case KernelType::cubic_spline:
      return planar ? KernelNorms{40.0 / 7.0, 240.0 / 7.0} : KernelNorms{8.0, 48.0};
    case KernelType::poly6:
      return planar ? KernelNorms{4.0, 24.0} : KernelNorms{315.0 / 64.0, 945.0 / 32.0};
    case KernelType::spiky:
      return planar ? KernelNorms{10.0, 30.0} : KernelNorms{15.0, 45.0};
    case KernelType::viscosity:
      return planar ? KernelNorms{40.0, 40.0} : KernelNorms{7.5, 7.5};
    case KernelType::wendland_c2:
      break;
  }
  return planar ? KernelNorms{7.0, 140.0} : KernelNorms{10.5, 210.0};
}

/// Of (33): lap W = this/h^(d+2) (1-q), times 1/pi.
constexpr double viscosityLaplacianNorm(bool planar) { return planar ? 40.0 : 45.0; }

struct SmoothingKernel {
  KernelType type = KernelType::wendland_c2;
  double h = 1.0;      ///< support radius, m
  double layer = 0.0;  ///< thickness of a planar world's layer, m; 0: three dimensions

  bool planar() const { return layer > 0.0; }
  /// W(r), 1/m^3. Viscosity: r > 0.
  double value(double r) const { return r < h ? scale() * shape(r / h).value : 0.0; }
  /// dW/dr, 1/m^4; <= 0. Viscosity: r > 0.
  double slope(double r) const { return r < h ? scale() / h * shape(r / h).slope : 0.0; }
  /// lap W, 1/m^5, r > 0.
  double laplacian(double r) const {
    if (r >= h) return 0.0;
    const Shape s = shape(r / h);
    return scale() / (h * h) * (s.curvature + (planar() ? 1.0 : 2.0) * s.slope * h / r);
  }

 private:
  /// f and its first two derivatives by q.
  struct Shape {
    double value, slope, curvature;
  };

  double scale() const {
    const double norm = kernelNorms(type, planar()).weight / std::numbers::pi;
    return planar() ? norm / (h * h * layer) : norm / (h * h * h);
  }

  Shape shape(double q) const {
    const double t = 1.0 - q;
    switch (type) {
      case KernelType::cubic_spline:
        if (q > 0.5) return {2.0 * t * t * t, -6.0 * t * t, 12.0 * t};
        return {1.0 - 6.0 * q * q * t, q * (18.0 * q - 12.0), 36.0 * q - 12.0};
      case KernelType::poly6: {
        const double u = 1.0 - q * q;
        return {u * u * u, -6.0 * q * u * u, -6.0 * u * u + 24.0 * q * q * u};
      }
      case KernelType::spiky:
        return {t * t * t, -3.0 * t * t, 6.0 * t};
      case KernelType::viscosity:
        if (planar()) {
          return {q * q / 4.0 - q * q * q / 9.0 - std::log(q) / 6.0 - 5.0 / 36.0, q / 2.0 - q * q / 3.0 - 1.0 / (6.0 * q),
                  0.5 - 2.0 * q / 3.0 + 1.0 / (6.0 * q * q)};
        }
        return {-0.5 * q * q * q + q * q + 0.5 / q - 1.0, -1.5 * q * q + 2.0 * q - 0.5 / (q * q),
                2.0 - 3.0 * q + 1.0 / (q * q * q)};
      case KernelType::wendland_c2:
        break;
    }
    return {t * t * t * t * (1.0 + 4.0 * q), -20.0 * q * t * t * t, -20.0 * t * t * (t - 3.0 * q)};
  }
};

}  // namespace bleedsim::sph
