// Plane flow of blood that thins with the shear rate, in closed form or integrated: the references of case 7.
#pragma once

#include <functional>

#include "service/sph/world_description.h"

namespace bleedsim::lab {

inline constexpr double kPlateHalf = 0.005;  ///< a, m: plates at y = +-a

struct PlaneFlow {
  double gradient = 0.0;  ///< G, Pa/m
  sph::Rheology rheology;
  std::function<double(double)> at;  ///< u(y), m/s
  double largest = 0.0;              ///< m/s
};

/// tau_y 5 mPa, G = 10 Pa/m. Beyond y_c = tau_y/G: u = [G (a^2 - y^2)/2 + tau_y (a - y) - (4/3) sqrt(tau_y G) (a^1.5 -
/// y^1.5)]/mu_c; the plug within moves as one.
PlaneFlow cassonFlow();
/// G = 22.81 Pa/m. mu(g) g = G y, solved by bisection, and integrated from the plate inwards; linear between 2000 nodes.
PlaneFlow carreauFlow();

/// The flow `seconds` after it was started at `part` of its profile: rho u_t = G + (mu(|u_y|) u_y)_y by implicit steps of 1 ms on
/// 200 cells, mu that of the step before.
PlaneFlow flowAfter(const PlaneFlow& flow, double part, double seconds);

double meanSpeed(const PlaneFlow& flow);  ///< m/s

}  // namespace bleedsim::lab
