// Adhesion of blood to tissue (a BodyEffect).
//
//   a_i = -k_ad f(d) n_w      f = 1 for d < dx, falling linearly to 0 at d = h
// terms: k_ad m/s^2; d the distance to the nearest tissue, n_w its normal into the blood. Above an open wound there is no tissue:
// the pull fades with the tissue's share.
// The paper lets blood stick to the organ's surface without a formula; this is bleedsim's own.
#pragma once

namespace bleedsim::sph {

template <class Real>
struct Adhesion {
  Real acceleration = 0;  ///< k_ad, m/s^2; 0: none
  Real spacing = 0;       ///< dx, m
  Real reach = 0;         ///< h, m

  /// Along the tissue's normal, m/s^2; <= 0.
  Real along(Real distance) const {
    if (distance < spacing) return -acceleration;
    return distance < reach ? -acceleration * (reach - distance) / (reach - spacing) : Real(0);
  }
};

}  // namespace bleedsim::sph
