// A wound's throat: a column of particles behind the patch that moves as one and feeds the surface.
//
// Particle j = serial x S + rank(site) of the wound crosses the patch when the column, the integral of Q dt / dx^3, reaches j
// + 1. Its height follows from the column alone, z = (column - (j + 1)) gap / S, so nothing drifts, the number that has crossed
// is floor(column) whatever the flow did, and one counter says which particles exist.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "service/sph/wound/inlet_tag.h"
#include "service/sph/wound/patch_geometry.h"
#include "service/sph/wound/patch_sites.h"
#include "service/sph/wound/site_grid.h"
#include "service/status/status.h"

namespace bleedsim::sph {

class StateReader;
class StateWriter;

/// Of the place where particles are set free, in front of the patch, in spacings.
constexpr double kReleaseHeight = 0.5;

enum class InletPhase {
  throat,    ///< z < 0: behind the patch, unseen
  emerging,  ///< 0 <= z < dx/2: emitted, still moved by the throat
  released,  ///< z >= dx/2: free from now on, with the state's velocity
};

struct InletState {
  Vec3 position = Vec3::Zero();  ///< m
  Vec3 velocity = Vec3::Zero();  ///< m/s
  InletPhase phase = InletPhase::throat;
};

/// A particle that the throat needs now.
struct InletSpawn {
  std::uint32_t tag = 0;
  InletState state;
};

/// What one step did.
struct InletStep {
  std::uint64_t emitted = 0;  ///< particles that crossed the patch
  std::uint64_t refused = 0;  ///< that would have, had there been room when the throat needed them
};

class Throat {
 public:
  /// How a throat that follows another one starts.
  struct Start {
    double head_start = 0.0;       ///< 0 <= . < 1: the part of the next particle that is already due
    std::vector<double> ceilings;  ///< empty, or by site the height that its first particle had better not exceed, m
  };

  /// Opens with an empty column: no particle is at z >= 0. Sites with low ceilings get late turns.
  Throat(std::uint32_t slot, const PatchFrame& frame, const PatchSites& patch, double spacing, double support_radius,
         const Start& start = Start{0.0, {}});

  /// Particles per second, flow / dx^3. Acts at once.
  void setRate(double rate) { rate_ = rate; }

  /// Moves the column to the step's end. place(const InletSpawn&) -> bool is called for each particle that enters the throat;
  /// false leaves a hole that is never emitted, and counts as refused when it would have crossed. Allocates nothing.
  /// Requires dt >= 0 and columnSpeed() dt <= 8 dx.
  template <class Place>
  InletStep advance(double dt, Place&& place) {
    before_ = {column_, entered_, crossed_};
    holes_kept_ = false;
    moveColumn(dt);
    for (; entered_ < enteringBound(); ++entered_) {
      if (!place(InletSpawn{tagOf(entered_), stateOf(entered_)})) makeHole(entered_);
    }
    return countCrossings();
  }

  /// Takes the last advance() back, once. What it placed is the owner's to remove.
  void rewind();

  /// Of a particle that this throat placed and that was not yet seen as released in an earlier step.
  InletState kinematics(const InletTag& tag) const { return stateOf(ordinalOf(tag)); }

  /// The share of the tissue about `local` = (u, v, z) for which the throat's own particles stand, 0..1. The sum over full
  /// sites of dx^2 times a normalised lateral kernel of the support radius: 1 well inside, about 1/2 on a straight edge,
  /// 0 beyond h outside, above h and below the throat. 0 for a sparse throat (gap > 1.5 dx), whose particles cannot hold
  /// blood back; they are released above the tissue's surface, so they need no opening. A site with a hole does not count.
  double openFraction(const Vec3& local) const;

  /// visit(position, m) of the last particles to cross, up to a spacing above the patch: exact while they are emerging, and
  /// beyond where the column would have them.
  template <class Visit>
  void forEachJustEmitted(Visit&& visit) const {
    for (std::uint64_t j = crossed_; j > 0 && heightOf(j - 1) < 2.0 * release_height_; --j) visit(stateOf(j - 1).position);
  }

  /// Where the column is and which particles exist; the rest follows from how the throat was opened.
  void save(StateWriter& out) const;
  /// On a throat that was opened for the same patch: data_loss says what is wrong, and this one is then of no more use.
  Status restore(StateReader& in);
  /// Whether kinematics() may be asked of this tag.
  bool mayDrive(const InletTag& tag) const;

  /// Of particles now behind the patch: those that vanish when the wound moves or closes.
  std::uint64_t unseen() const;

  double columnSpeed() const { return speedFor(rate_); }                      ///< m/s
  double speedFor(double rate) const { return rate * height_per_particle_; }  ///< m/s, of a rate in particles per second
  double column() const { return column_; }  ///< particles due since opening, the head start included
  double depth() const { return depth_; }    ///< of the deepest particle behind the patch, at most, m
  double gap() const { return gap_; }        ///< m
  double area() const { return area_; }      ///< m^2
  bool sparse() const { return sparse_; }
  double reach() const { return reach_; }  ///< no opening further than this from the origin, m
  std::uint32_t slot() const { return slot_; }
  const PatchFrame& frame() const { return frame_; }
  const SiteGrid& grid() const { return grid_; }
  const std::vector<Vec2>& sites() const { return grid_.sites(); }

 private:
  void moveColumn(double dt) { column_ += rate_ * dt; }
  std::uint64_t enteringBound() const;
  InletStep countCrossings();
  std::uint64_t ordinalOf(const InletTag& tag) const;
  std::uint32_t tagOf(std::uint64_t ordinal) const;
  InletState stateOf(std::uint64_t ordinal) const;
  double heightOf(std::uint64_t ordinal) const;
  void makeHole(std::uint64_t ordinal);
  void keepHoles();
  bool isHole(std::uint64_t ordinal) const;

  std::uint32_t slot_ = 0;
  PatchFrame frame_;
  SiteGrid grid_;
  double area_ = 0.0;
  double gap_ = 0.0;
  double depth_ = 0.0;
  double reach_ = 0.0;
  double release_height_ = 0.0;
  double support_radius_ = 0.0;
  double opening_weight_ = 0.0;       // of a site at distance 0
  double height_per_particle_ = 0.0;  // gap / S
  bool sparse_ = false;
  double rate_ = 0.0;
  double column_ = 0.0;
  std::uint64_t entered_ = 0;  // particles j < entered_ were placed or refused
  std::uint64_t crossed_ = 0;  // particles j < crossed_ crossed the patch
  std::vector<std::uint32_t> site_of_rank_;
  std::vector<std::uint32_t> rank_of_site_;
  std::vector<std::uint64_t> holes_;  // by site, one bit for each serial modulo 64
  struct Before {
    double column = 0.0;
    std::uint64_t entered = 0, crossed = 0;
  };
  Before before_;                            // the last advance()
  std::vector<std::uint64_t> holes_before_;  // as large as holes_
  bool holes_kept_ = false;                  // holes_before_ is of the last advance()
};

}  // namespace bleedsim::sph
