// A hard case in the making: its worlds, each watched in every step, and the figures that it gives.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "service/lab/hardcases/always.h"
#include "service/lab/hardcases/hard_case.h"

namespace bleedsim::lab {

/// One world of a case. A step that fails ends the case; the functions then return false.
class Trial {
 public:
  Trial(std::unique_ptr<sph::World> world, HardOutcome& outcome, Always& always);
  ~Trial();
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  sph::World& world() { return *world_; }
  const sph::World& world() const { return *world_; }

  [[nodiscard]] bool step(double limit = std::numeric_limits<double>::infinity());
  /// To within a step; `each` after every step.
  [[nodiscard]] bool runFor(
      double seconds, const std::function<void()>& each = [] {});
  [[nodiscard]] bool runSteps(
      int steps, const std::function<void()>& each = [] {});
  /// A command that must be accepted.
  [[nodiscard]] bool apply(const sph::Command& command);
  /// The world goes on as one of another description.
  [[nodiscard]] bool change(std::unique_ptr<sph::World> world);

  sph::WorldStats stats() const;
  std::uint64_t counted(sph::Counter counter) const;
  const sph::FrameBuffer& frame() { return watch_.look(*world_); }

 private:
  std::unique_ptr<sph::World> world_;
  HardOutcome& outcome_;
  AlwaysWatch watch_;
};

class CaseRun {
 public:
  explicit CaseRun(const CaseSetup& setup) : setup_{setup} {}

  const CaseSetup& setup() const { return setup_; }
  bool all() const { return setup_.effects == EffectChoice::all; }
  bool literal() const { return setup_.model == sph::Model::literal; }
  /// `in_float` or `in_double`, by the precision.
  double byPrecision(double in_float, double in_double) const {
    return setup_.precision == sph::Precision::float32 ? in_float : in_double;
  }

  /// The description with the setup's model and effects.
  sph::WorldDescription prepared(sph::WorldDescription scene) const;
  /// A world of prepared(scene); null where that is refused, which ends the case.
  std::unique_ptr<Trial> start(const sph::WorldDescription& scene, int threads = 1);
  /// A world of just that description, not watched.
  std::unique_ptr<sph::World> build(const sph::WorldDescription& prepared_scene, int threads = 1);

  void atMost(std::string name, double value, double bound);
  void atLeast(std::string name, double value, double bound);
  void within(std::string name, double value, double lowest, double highest);
  void told(std::string name, double value);
  /// A figure that only counts without effects that the case is not about.
  void atMostIfNeeded(std::string name, double value, double bound) {
    all() ? told(std::move(name), value) : atMost(std::move(name), value, bound);
  }

  HardOutcome finish() &&;

 private:
  CaseSetup setup_;
  HardOutcome outcome_;
  Always always_;
};

}  // namespace bleedsim::lab
