// The simulation: particles, tissue, wounds and the effects of one scene, advanced one step at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "service/sph/command.h"
#include "service/sph/running_code.h"
#include "service/sph/simd_target.h"
#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::sph {

enum class Precision { float32, float64 };  ///< float64 is the reference and runs on the scalar twin only

struct WorldOptions {
  int threads = 1;  ///< 1..64; results are bit-equal for any value
  SimdTarget simd = SimdTarget::automatic;
  Precision precision = Precision::float32;
  /// Tests all pairs instead of the 27 cells around each particle, for measurements of what the cells gain: the step's cost goes
  /// with the square of the count. All particles then stand in one cell, so one thread does all pair sums, and from about 1800
  /// particles on no lists are kept and Counter::neighbor_overflow counts every particle-step. Not with periodic sides.
  bool complete_search = false;
  /// m/s, instead of the description's: a world that takes over another one's state must keep its speed of sound, because a
  /// change of it pumps energy.
  std::optional<double> speed_of_sound = {};
};

/// The stages of World::step, in order.
enum class Stage { emit, move, neighbors, tissue, density, force, body, integrate, count };
std::string_view stageName(Stage stage);

/// Everything that is counted. Each rises only.
enum class Counter {
  speed_clamped,          ///< particle-steps at which |v| was cut to v_cap = 2 c0
  acceleration_clamped,   ///< particle-steps at which |a| was cut to its bound
  tissue_projected,       ///< particles found behind tissue and put back
  left_domain,            ///< particles removed at the domain's sides
  emission_refused,       ///< particles that a wound could not emit because the world is at capacity
  inlet_withdrawn,        ///< particles of a wound's throat taken back, never emitted (wound moved or removed)
  neighbor_overflow,      ///< particle-steps beyond the neighbour list, handled by the slow path
  force_without_fluid,    ///< source-steps with no particle within reach
  force_expired,          ///< force sources that ended by their time
  viscosity_unsolved,     ///< steps whose implicit viscosity did not reach its tolerance
  coincident_parted,      ///< particles that stood on another one's spot and were set apart
  step_retried,           ///< steps taken back and tried with half the time (service/sph/recovery.h)
  infinite_force_capped,  ///< particle-steps of such a step at which an infinite force was capped; no acceleration_clamped
  particle_frozen,        ///< particle-steps without a finite force: stopped where they were
  count
};
std::string_view counterName(Counter counter);

/// Optional per-particle outputs of a frame.
enum FrameAttribute : std::uint32_t {
  kFrameVelocity = 1u << 0,
  kFrameDensity = 1u << 1,
  kFrameViscosity = 1u << 2,
  kFramePlatelet = 1u << 3,  ///< with the platelets effect
  kFrameRadius = 1u << 4,    ///< with the core radius effect
};

/// A copy of the visible particles; buffers are sized once with reserve() and reused. Order is storage order; ids are stable.
struct FrameBuffer {
  std::uint64_t step = 0;
  double time = 0.0;  ///< s
  std::uint32_t count = 0;
  std::uint32_t attributes = 0;   ///< FrameAttribute bits that are filled
  std::vector<float> position;    ///< 3 x count, m
  std::vector<std::uint32_t> id;  ///< count
  std::vector<float> velocity;    ///< 3 x count, m/s
  std::vector<float> density;     ///< count, kg/m^3
  std::vector<float> viscosity;   ///< count, Pa s: that which acts now
  std::vector<float> platelet;    ///< count, P from 0 to 1; 0 without platelets
  std::vector<float> radius;      ///< count, own support radius, m

  void reserve(std::uint32_t capacity, std::uint32_t attributes_wanted);
};

struct WoundState {
  std::uint32_t id = 0;
  double emitted = 0.0;  ///< m^3 so far
  double flow = 0.0;     ///< m^3/s now
};

struct WorldStats {
  std::uint64_t step = 0;
  double time = 0.0;            ///< s
  double dt = 0.0;              ///< s, of the last step
  std::uint32_t particles = 0;  ///< visible: injected - removed
  std::uint64_t injected = 0;   ///< seeded or emitted
  std::uint64_t removed = 0;
  double emitted_volume = 0.0;      ///< m^3, by all wounds, removed ones included
  double commanded_volume = 0.0;    ///< m^3, integral of the commanded flow
  double mean_density_error = 0.0;  ///< mean of max(0, rho/rho0 - 1)
  double max_density_error = 0.0;
  double max_speed = 0.0;                                              ///< m/s
  int viscosity_iterations = 0;                                        ///< of the implicit solve in the last step; 0: explicit
  double kinetic_energy = 0.0;                                         ///< J
  Vec3 momentum = Vec3::Zero();                                        ///< kg m/s, of the free particles
  Vec3 center = Vec3::Zero();                                          ///< m, of the free particles' mass; zero without any
  std::array<double, static_cast<int>(Stage::count)> stage_seconds{};  ///< summed since creation
  std::array<std::uint64_t, static_cast<int>(Counter::count)> counters{};
};

/// What a world has reserved, bytes. Everything is reserved at creation, for the capacity.
struct MemoryUse {
  std::size_t particles = 0;  ///< state, twice for the sort
  std::size_t passes = 0;     ///< records, densities, accelerations
  std::size_t lists = 0;      ///< neighbour lists
  std::size_t grid = 0;
  std::size_t tissue = 0;
  std::size_t effects = 0;  ///< arrays that effects own beside the others
};

/// What apply() did.
struct Applied {
  std::uint32_t object_id = 0;  ///< of the wound added or touched, 0: none
};

/// Not thread-safe: one thread owns it. step() and copyFrame() neither allocate, throw, log nor call the middleware.
class World {
 public:
  virtual ~World() = default;

  /// Acts before the next step. A refusal leaves the state untouched and says why and what would be accepted.
  virtual Result<Applied> apply(const Command& command) = 0;

  /// What apply() would answer to a command of a wound now; nothing changes. ok for other commands.
  virtual Status checkWound(const Command& command) const = 0;

  /// Advances by dt = min(stable dt, dt_limit), or by a fraction of it where that step did not hold (recovery.h).
  /// invalid_argument unless dt_limit > 0; internal once no step gives a finite state (the world is then faulted and stays as it
  /// was before that step).
  virtual Status step(double dt_limit) = 0;

  virtual std::uint64_t stepCount() const = 0;
  virtual double time() const = 0;
  /// Particles that exist now, the unseen ones in wounds' throats left out.
  virtual std::uint32_t particleCount() const = 0;

  /// Statistics with the reductions that are not needed every step. O(n).
  virtual void collectStats(WorldStats& stats) const = 0;
  virtual std::span<const WoundState> wounds() const = 0;
  /// Fills `frame`, which must have been reserved for this world's capacity and the attributes.
  virtual void copyFrame(FrameBuffer& frame, std::uint32_t attributes) const = 0;
  /// Hash of the complete state (positions, velocities, ids, time); equal states have equal hashes.
  virtual std::uint64_t stateHash() const = 0;

  /// Takes over the complete state of `from`, a world of the same description but for its effects: particles, wounds with their
  /// throats, force sources, ledgers, counters, time and step. Goes on as `from` would have; the first half kick is still that of
  /// the effects of `from`. Quantities that `from` does not carry start as in fresh blood. Allocates nothing. `from` must not be
  /// stepped afterwards. invalid_argument: the descriptions differ in more than effects; capacity: more force sources than
  /// this world has; both leave both worlds as they are.
  virtual Status adopt(World& from) = 0;

  /// Bytes that saveState() needs now.
  virtual std::size_t stateBytes() const = 0;
  /// Writes the complete state and returns how many bytes it takes; 0 if `room` is too small or the world is faulted. Allocates
  /// nothing.
  virtual std::size_t saveState(std::span<std::byte> room) const = 0;
  /// Takes the state that a world of the same description, precision and speed of sound has saved, and goes on bit for bit as
  /// that one did, on any number of threads. invalid_argument: it is another world's; data_loss: it is damaged. The message says
  /// what is wrong, and this world stays as it is. Allocates: not for the simulation thread.
  virtual Status restoreState(std::span<const std::byte> state) = 0;

  /// Empty: the wound has none, or there is no such wound.
  virtual std::string_view woundName(std::uint32_t id) const = 0;

  virtual const WorldDescription& description() const = 0;
  virtual SimdTarget simdTarget() const = 0;
  virtual double speedOfSound() const = 0;  ///< m/s
  virtual double particleMass() const = 0;  ///< kg, calibrated on the rest lattice
  virtual bool faulted() const = 0;
  virtual MemoryUse memory() const = 0;
  virtual RunningCode runningCode() const = 0;
};

/// Checks what only the solver can (capacity against blocks, wounds against tissue and speed of sound) and builds the world.
/// May allocate and take long: not for the simulation thread.
Result<std::unique_ptr<World>> createWorld(const WorldDescription& description, const WorldOptions& options);

/// One row per effect that this build knows.
struct EffectInfo {
  std::string_view name;
  std::string_view equation;  ///< of the paper, or of the source
  std::string_view source;
  std::string_view deviation;     ///< from the paper
  std::string_view literal = {};  ///< what it is in the literal model; empty: not in it
};
std::span<const EffectInfo> effectCatalog();
/// Whether the description enables the effect of that name.
bool effectEnabled(const WorldDescription& description, std::string_view name);

}  // namespace bleedsim::sph
