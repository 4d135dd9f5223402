// Forces on the fluid from instruments and commands (a BodyEffect).
//
// A source pushes F newtons on the particles within its radius R: a_i = F w_i / (m sum_j w_j), w = (1-q)^4 (1+4q), q = r/R, so
// the sum over the fluid is exactly F. The sums are taken in storage order in double: the same for any thread count.
// The paper moves no instruments; this is bleedsim's own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "service/sph/command.h"
#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/particles.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// What applying the sources in one step ran into.
struct AppliedForceEvents {
  std::uint32_t expired = 0;
  std::uint32_t without_fluid = 0;
};

/// invalid_argument unless every number is finite, the force at most kForce, the radius at most the domain's diagonal, and the
/// sphere reaches into the domain.
Status checkForce(const SetForce& source, const Domain& domain);

template <class Real>
class AppliedForce {
 public:
  AppliedForce(std::uint32_t max_sources, double mass, double h, const Domain& domain)
      : max_sources_{max_sources}, mass_{mass}, h_{h}, domain_{domain} {
    sources_.reserve(max_sources);
  }

  Status set(const SetForce& source) {
    if (Status status = checkForce(source, domain_); !status.ok()) return status;
    for (SetForce& existing : sources_) {
      if (existing.key == source.key) {
        existing = source;
        return {};
      }
    }
    if (sources_.size() >= max_sources_) {
      return {StatusCode::capacity, "all " + std::to_string(max_sources_) +
                                        " force sources are in use; wait until one ends or raise applied_force.max_sources"};
    }
    sources_.push_back(source);
    return {};
  }

  Status remove(ForceKey key) {
    const auto found = std::find_if(sources_.begin(), sources_.end(), [key](const SetForce& s) { return s.key == key; });
    if (found == sources_.end()) return {StatusCode::not_found, "there is no force source with this key"};
    sources_.erase(found);
    return {};
  }

  /// Ends the sources whose time has come, then adds the others at `time` to the accelerations (4 per particle).
  AppliedForceEvents add(double time, const CellGrid<Real>& grid, const Particles<Real>& p, Real* acceleration) {
    AppliedForceEvents events;
    const auto ended = std::remove_if(sources_.begin(), sources_.end(), [time](const SetForce& s) { return s.until <= time; });
    events.expired = static_cast<std::uint32_t>(sources_.end() - ended);
    sources_.erase(ended, sources_.end());
    for (const SetForce& source : sources_) {
      if (!addOne(source, grid, p, acceleration)) ++events.without_fluid;
    }
    return events;
  }

  bool empty() const { return sources_.empty(); }
  std::size_t bytes() const { return sources_.capacity() * sizeof(SetForce); }

  bool canHold(const AppliedForce& other) const { return other.sources_.size() <= max_sources_; }
  /// Takes over the other's sources; requires canHold().
  void adopt(const AppliedForce& other) { sources_.assign(other.sources_.begin(), other.sources_.end()); }

  /// In the order in which they are summed up.
  std::span<const SetForce> sources() const { return sources_; }
  std::uint32_t maxSources() const { return max_sources_; }
  void clear() { sources_.clear(); }

 private:
  bool addOne(const SetForce& source, const CellGrid<Real>& grid, const Particles<Real>& p, Real* acceleration) const {
    double total = 0.0;
    forEachWithin(source, grid, p, [&](std::uint32_t, double weight) { total += weight; });
    if (!(total > 0.0)) return false;
    const Vec3 share = source.force / (mass_ * total);
    forEachWithin(source, grid, p, [&](std::uint32_t i, double weight) {
      for (std::uint32_t a = 0; a < 3; ++a) acceleration[std::size_t{i} * 4 + a] += static_cast<Real>(share[a] * weight);
    });
    return true;
  }

  template <class Visit>
  void forEachWithin(const SetForce& source, const CellGrid<Real>& grid, const Particles<Real>& p, Visit&& visit) const {
    const GridView<Real>& view = grid.view();
    const double reach = source.radius / h_;
    std::array<int, 3> first{};
    std::array<int, 3> last{};
    std::array<double, 3> center{};
    for (std::size_t a = 0; a < 3; ++a) {
      center[a] = source.position[static_cast<Eigen::Index>(a)] / h_;
      first[a] = view.periodic[a] ? 1 : cellOf(grid, a, center[a] - reach);
      last[a] = view.periodic[a] ? view.size[a] - 2 : cellOf(grid, a, center[a] + reach);
    }
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        const int row = z * view.size[1] + y;
        const std::uint32_t end = view.start[view.cell(row, last[0]) + 1];
        for (std::uint32_t i = view.start[view.cell(row, first[0])]; i < end; ++i) {
          if (p.driver[i] != 0) continue;  // a throat's particle goes where the wound drives it
          const double dx = offset(view, 0, static_cast<double>(p.x[i]) - center[0]);
          const double dy = offset(view, 1, static_cast<double>(p.y[i]) - center[1]);
          const double dz = offset(view, 2, static_cast<double>(p.z[i]) - center[2]);
          const double q2 = (dx * dx + dy * dy + dz * dz) / (reach * reach);
          if (q2 >= 1.0) continue;
          const double q = std::sqrt(q2);
          const double t2 = (1.0 - q) * (1.0 - q);
          visit(i, t2 * t2 * (1.0 + 4.0 * q));
        }
      }
    }
  }

  static int cellOf(const CellGrid<Real>& grid, std::size_t axis, double value) {
    return grid.coordinate(axis, static_cast<Real>(std::clamp(value, -1e5, 1e5)));
  }
  static double offset(const GridView<Real>& view, std::size_t axis, double d) {
    if (!view.periodic[axis]) return d;
    const double period = static_cast<double>(view.period[axis]);
    return d - period * std::nearbyint(d / period);
  }

  std::uint32_t max_sources_;
  double mass_;  // kg, of a particle
  double h_;     // m
  Domain domain_;
  std::vector<SetForce> sources_;
};

}  // namespace bleedsim::sph
