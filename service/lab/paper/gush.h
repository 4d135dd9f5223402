// Blood that gushes from the wounds of a scene until there is so much of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "service/sph/world.h"
#include "service/status/status.h"

namespace bleedsim::lab {

/// The particles that exist: x, y, z each.
struct GushBody {
  std::span<const float> positions;   ///< m
  std::span<const float> velocities;  ///< m/s

  std::size_t count() const { return positions.size() / 3; }
};

class Gush {
 public:
  /// Room for `particles` emitted ones is made. The scene needs a wound.
  static Result<Gush> create(sph::WorldDescription scene, const sph::WorldOptions& options, std::uint32_t particles);

  /// Steps until `particles` have been emitted. internal: the state stopped being finite; timed_out: three times the time that
  /// the wounds' flow needs was not enough.
  Status growTo(std::uint32_t particles);

  /// Valid until the next call.
  GushBody body();

  /// How far a particle's P is from that of fresh blood, at most; nothing without platelets.
  std::optional<double> plateletChange();

  std::uint32_t emitted() const;
  std::uint32_t present() const { return world_->particleCount(); }  ///< those that left the domain are gone
  const sph::World& world() const { return *world_; }

 private:
  Gush(std::unique_ptr<sph::World> world, std::uint32_t capacity);

  std::unique_ptr<sph::World> world_;
  sph::FrameBuffer frame_;
};

}  // namespace bleedsim::lab
