// All wounds of a world: their validation, their throats, and the ledger of what they emitted.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "service/sph/command.h"
#include "service/sph/world.h"
#include "service/sph/world_description.h"
#include "service/sph/wound/periodic_offset.h"
#include "service/sph/wound/throat.h"
#include "service/sph/wound/wound_rules.h"
#include "service/status/status.h"

namespace bleedsim::sph {

/// Called when a throat is taken back, after every check has passed and before anything changes. The owner of the particles
/// goes through those whose driver tag has the throat's slot: those still in phase `throat` are deleted, all others
/// become free with the state's velocity. Their number behind the patch is Throat::unseen().
using WithdrawThroat = std::function<void(const Throat&)>;

class WoundSet {
 public:
  /// `speed_of_sound` in m/s. At most min(description.max_wounds, kMaxInletSlots) wounds exist at a time. The description's own
  /// wounds are not added.
  WoundSet(const WorldDescription& description, double speed_of_sound);

  /// The new wound's id: from 1, rising, never reused. Refusals leave everything as it is:
  /// invalid_argument: a value that is not finite or out of range, a zero normal, a patch outside the domain, too wide for a
  /// periodic side, inside tissue or over another wound's, a column faster than the scene's limit; capacity: too many wounds or
  /// sites.
  Result<std::uint32_t> add(const WoundDescription& wound);

  /// Changes the fields that are given. Another position, normal, tangent or any shape withdraws the throat and opens a new one,
  /// which keeps the fraction of a particle that was due and keeps clear of what was just emitted; flow and name act without.
  /// not_found: no such wound; else as add().
  Status update(const UpdateWound& change, const WithdrawThroat& withdraw);

  /// not_found: no such wound. What it emitted stays in the totals.
  Status remove(std::uint32_t id, const WithdrawThroat& withdraw);

  /// What add(), update() and remove() would answer now; nothing changes.
  Status check(const AddWound& change) const;
  Status check(const UpdateWound& change) const;
  Status check(const RemoveWound& change) const;

  /// Moves every column to the end of a step of `dt` s; see Throat::advance. Wounds act in the order of their ids. Tagged
  /// particles then take their state from kinematics(). Allocates nothing.
  template <class Place>
  InletStep advance(double dt, Place&& place) {
    InletStep total;
    before_ = {emitted_, refused_, commanded_};
    for (std::size_t i = 0; i < wounds_.size(); ++i) {
      wounds_[i].emitted_before = wounds_[i].emitted;
      const InletStep step = wounds_[i].throat.advance(dt, [&](InletSpawn spawn) {
        wrapInto(rules_.domain(), spawn.state.position);
        return static_cast<bool>(place(std::as_const(spawn)));
      });
      book(i, step, dt);
      total.emitted += step.emitted;
      total.refused += step.refused;
    }
    return total;
  }

  /// Takes the last advance() back, once, with all that it booked. No wound may have come, changed or gone since.
  void rewind();

  /// Where a tagged particle is now. On periodic axes inside the domain; elsewhere a throat may reach out of the domain, which
  /// is no reason to remove its particles. A particle found `released` must be given free (tag 0) in the same step.
  InletState kinematics(std::uint32_t tag) const;

  /// The share of the tissue near a point (m) that is open because a throat's particles stand there in its stead, 0..1;
  /// see Throat::openFraction. Wall share, gradient, spring and friction are multiplied by 1 - openFraction. Valid after
  /// advance() has filled the throats. Cheap far from wounds.
  double openFraction(const Vec3& position) const;

  /// Whether openFraction() may differ from 0 in the box between two corners, m. Cheap.
  bool mayOpen(const Vec3& lower, const Vec3& upper) const;

  bool empty() const { return wounds_.empty(); }
  /// The existing wounds, by rising id.
  std::span<const WoundState> states() const { return states_; }
  /// nullptr if there is no such wound.
  const WoundDescription* description(std::uint32_t id) const;
  const Throat* throat(std::uint32_t id) const;

  std::uint64_t emittedParticles() const { return emitted_; }      ///< by all wounds, removed ones included
  std::uint64_t refusedParticles() const { return refused_; }      ///< Counter::emission_refused
  std::uint64_t withdrawnParticles() const { return withdrawn_; }  ///< Counter::inlet_withdrawn
  double emittedVolume() const { return static_cast<double>(emitted_) * particle_volume_; }  ///< m^3
  double commandedVolume() const { return commanded_ * particle_volume_; }                   ///< m^3, integral of the flow
  double deepestThroat() const;  ///< m behind the patch, of all wounds

  /// All wounds, their throats and the ledger. Allocates nothing.
  void save(StateWriter& out) const;
  /// Of a set for the same description and speed of sound, in place of all wounds. data_loss says what is wrong, and this set is
  /// then of no more use.
  Status restore(StateReader& in);
  /// Whether kinematics() may be asked of this tag.
  bool mayDrive(std::uint32_t tag) const;

 private:
  struct Wound {
    std::uint32_t id = 0;
    WoundDescription description;
    Throat throat;
    std::uint64_t emitted = 0;
    std::uint64_t emitted_before = 0;  // the last advance()
  };
  struct Ledger {
    std::uint64_t emitted = 0, refused = 0;
    double commanded = 0.0;
  };

  struct Addition {
    Throat throat;
    double rate = 0.0;  // particles/s
  };
  struct Revision {
    std::size_t index = 0;
    WoundDescription description;
    std::optional<Throat> reopened;
    double rate = 0.0;  // particles/s
  };

  Result<Addition> planAddition(const WoundDescription& wound) const;
  Result<Revision> planRevision(const UpdateWound& change) const;
  std::size_t indexOf(std::uint32_t id) const;
  Status unknown(std::uint32_t id) const;
  Status checkNameAndDrive(const WoundDescription& wound, std::uint32_t except_id) const;
  Result<Opening> planOpening(const WoundDescription& wound) const;
  Throat::Start startAfter(const Throat& before, const Opening& opening) const;
  Status checkClear(const Throat& candidate, std::uint32_t except_id) const;
  Result<double> planRate(const WoundDescription& wound, const Throat& throat) const;
  std::uint32_t freeSlot() const;
  void book(std::size_t index, const InletStep& step, double dt);
  void withdrawThroat(std::size_t index, const WithdrawThroat& withdraw);
  void refreshReach();
  Status restoreOne(StateReader& in, std::vector<bool>& taken);

  WoundRules rules_;
  double spacing_ = 0.0;
  double particle_volume_ = 0.0;
  std::uint32_t max_wounds_ = 0;
  std::uint32_t next_id_ = 1;
  std::vector<Wound> wounds_;                 // by rising id
  std::vector<WoundState> states_;            // parallel to wounds_
  std::vector<std::uint16_t> wound_of_slot_;  // index into wounds_
  std::vector<double> reach_;                 // m, parallel to wounds_; 0 where the tissue stays closed
  std::uint64_t emitted_ = 0;
  std::uint64_t refused_ = 0;
  std::uint64_t withdrawn_ = 0;
  double commanded_ = 0.0;  // particles
  Ledger before_;           // the last advance()
};

}  // namespace bleedsim::sph
