// What a world does with commands: wounds that open, change and close, and forces that push.
#include <algorithm>

#include "service/sph/world_core.h"

namespace bleedsim::sph {

template <class Real>
Result<Applied> WorldCore<Real>::apply(const Command& command) {
  const auto withdraw_throat = [this](const Throat& throat) { withdraw(throat); };
  if (const auto* add = std::get_if<AddWound>(&command)) {
    const Result<std::uint32_t> added = wounds_.add(add->wound);
    if (!added) return added.status();
    return Applied{*added};
  }
  if (const auto* update = std::get_if<UpdateWound>(&command)) {
    if (Status status = wounds_.update(*update, withdraw_throat); !status.ok()) return status;
    return Applied{update->wound_id};
  }
  if (const auto* remove = std::get_if<RemoveWound>(&command)) {
    if (Status status = wounds_.remove(remove->wound_id, withdraw_throat); !status.ok()) return status;
    return Applied{remove->wound_id};
  }
  if (!applied_force_) {
    return Status{StatusCode::unsupported, "this scene has no applied_force effect; add 'effects { applied_force {} }' to it"};
  }
  const auto* set = std::get_if<SetForce>(&command);
  if (Status status = set != nullptr ? applied_force_->set(*set) : applied_force_->remove(std::get<RemoveForce>(command).key);
      !status.ok()) {
    return status;
  }
  return Applied{};
}

template <class Real>
Status WorldCore<Real>::checkWound(const Command& command) const {
  if (const auto* add = std::get_if<AddWound>(&command)) return wounds_.check(*add);
  if (const auto* update = std::get_if<UpdateWound>(&command)) return wounds_.check(*update);
  if (const auto* remove = std::get_if<RemoveWound>(&command)) return wounds_.check(*remove);
  return {};
}

template <class Real>
void WorldCore<Real>::withdraw(const Throat& throat) {
  Real* a = passes_.acceleration();
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (particles_.driver[i] != 0 && unpackInletTag(particles_.driver[i]).slot == throat.slot()) {
      const InletState state = wounds_.kinematics(particles_.driver[i]);
      if (state.phase == InletPhase::throat) {
        --unseen_;
        continue;
      }
      particles_.driver[i] = 0;
      particles_.vx[i] = static_cast<Real>(state.velocity.x());
      particles_.vy[i] = static_cast<Real>(state.velocity.y());
      particles_.vz[i] = static_cast<Real>(state.velocity.z());
    }
    if (kept != i) {
      particles_.copyOne(kept, particles_, i);
      std::copy_n(a + std::size_t{i} * 4, 4, a + std::size_t{kept} * 4);
      passes_.moveDensity(kept, i);
    }
    ++kept;
  }
  count_ = kept;
}

template Result<Applied> WorldCore<float>::apply(const Command& command);
template Result<Applied> WorldCore<double>::apply(const Command& command);
template Status WorldCore<float>::checkWound(const Command& command) const;
template Status WorldCore<double>::checkWound(const Command& command) const;

}  // namespace bleedsim::sph
