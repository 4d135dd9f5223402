// What every step of every world must keep, physics.md section 6, "always": no NaN/Inf; nothing outside the tissue by more than
// 0.1 dx; count = injected - removed; |v| <= v_cap and no clamp uncounted; every step within its caps of iterations.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "service/lab/hardcases/hard_case.h"
#include "service/sph/world.h"

namespace bleedsim::lab {

/// The worst that was seen.
struct Always {
  std::uint64_t steps = 0;
  std::uint64_t not_finite = 0;                              ///< particle-steps
  double deepest = std::numeric_limits<double>::infinity();  ///< smallest signed distance to tissue, spacings
  std::uint64_t miscounted = 0;                              ///< steps at which count != injected - removed
  double fastest = 0.0;                                      ///< |v|/v_cap
  std::uint64_t uncounted_clamps = 0;                        ///< steps that brought more particles to v_cap than they counted
  std::uint64_t beyond_caps = 0;                             ///< steps with more iterations or retries than they may have
  std::uint64_t counters_fell = 0;                           ///< steps after which a counter was lower

  /// None of them broken.
  bool holds() const;
  std::vector<HardFigure> figures() const;
};

/// Looks at one world after each of its steps.
class AlwaysWatch {
 public:
  AlwaysWatch(const sph::World& world, Always& worst);

  /// After a step, or at the start.
  void check(const sph::World& world);
  /// A frame with every attribute.
  const sph::FrameBuffer& look(const sph::World& world);

 private:
  /// `clamps`: speeds that the step counted as clamped.
  void checkParticles(const sph::World& world, std::uint64_t clamps);
  void checkDepth(const sph::World& world);

  Always& worst_;
  sph::FrameBuffer frame_;
  std::vector<std::uint32_t> fast_;  ///< ids of those near v_cap at the last look, rising
  std::array<std::uint64_t, static_cast<std::size_t>(sph::Counter::count)> counters_{};
};

}  // namespace bleedsim::lab
