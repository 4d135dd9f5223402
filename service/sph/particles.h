// The particle state, structure of arrays. Positions are kept in support radii, so that the pair passes need no scaling.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "service/sph/aligned_array.h"

namespace bleedsim::sph {

template <class Real>
struct Particles {
  AlignedArray<Real> x, y, z;            ///< position / h, in the scene's frame
  AlignedArray<Real> vx, vy, vz;         ///< velocity, m/s
  AlignedArray<Real> inverse_viscosity;  ///< 1/(Pa s); empty unless viscosity differs between particles
  AlignedArray<Real> own_viscosity;      ///< Pa s, of a block that brings one, else 0; empty unless mu changes with time
  AlignedArray<Real> platelet;           ///< P, 0 to 1; empty without platelets
  AlignedArray<Real> radius;             ///< own support radius / h; empty without (34)
  AlignedArray<std::uint32_t> id;        ///< stable, never reused in a world
  AlignedArray<std::uint32_t> driver;    ///< 0: free; otherwise the tag of the wound's throat that moves the particle

  /// The arrays that a scene calls for.
  struct Fields {
    bool viscosity = false;
    bool platelet = false;
    bool radius = false;
    bool own_viscosity = false;
  };

  Particles() = default;
  Particles(std::size_t capacity, const Fields& fields, unsigned lane)
      : x{capacity, lane},
        y{capacity, lane + 1},
        z{capacity, lane + 2},
        vx{capacity, lane + 3},
        vy{capacity, lane + 4},
        vz{capacity, lane + 5},
        id{capacity, lane + 6},
        driver{capacity, lane + 7} {
    if (fields.viscosity) inverse_viscosity = AlignedArray<Real>{capacity, lane + 8};
    if (fields.platelet) platelet = AlignedArray<Real>{capacity, lane + 9};
    if (fields.radius) radius = AlignedArray<Real>{capacity, lane + 10};
    if (fields.own_viscosity) own_viscosity = AlignedArray<Real>{capacity, lane + 11};
  }

  static constexpr unsigned kArrays = 12;

  void copyOne(std::size_t to, const Particles& source, std::size_t from) {
    x[to] = source.x[from];
    y[to] = source.y[from];
    z[to] = source.z[from];
    vx[to] = source.vx[from];
    vy[to] = source.vy[from];
    vz[to] = source.vz[from];
    copyBody(to, source, from);
  }

  /// All but place and velocity, of `length` particles; to other arrays or, one alone, to another place of these.
  void copyBody(std::size_t to, const Particles& source, std::size_t from, std::size_t length = 1) {
    std::copy_n(source.id.data() + from, length, id.data() + to);
    std::copy_n(source.driver.data() + from, length, driver.data() + to);
    const auto copy = [&](AlignedArray<Real>& mine, const AlignedArray<Real>& theirs) {
      if (!mine.empty()) std::copy_n(theirs.data() + from, length, mine.data() + to);
    };
    copy(inverse_viscosity, source.inverse_viscosity);
    copy(own_viscosity, source.own_viscosity);
    copy(platelet, source.platelet);
    copy(radius, source.radius);
  }

  std::size_t bytes() const {
    std::size_t sum = id.bytes() + driver.bytes();
    for (const AlignedArray<Real>* array : {&x, &y, &z, &vx, &vy, &vz, &inverse_viscosity, &own_viscosity, &platelet, &radius})
      sum += array->bytes();
    return sum;
  }

  void swap(Particles& other) noexcept {
    x.swap(other.x);
    y.swap(other.y);
    z.swap(other.z);
    vx.swap(other.vx);
    vy.swap(other.vy);
    vz.swap(other.vz);
    inverse_viscosity.swap(other.inverse_viscosity);
    own_viscosity.swap(other.own_viscosity);
    platelet.swap(other.platelet);
    radius.swap(other.radius);
    id.swap(other.id);
    driver.swap(other.driver);
  }
};

}  // namespace bleedsim::sph
