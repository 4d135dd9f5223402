// Inviscid blood shut in between tissue keeps its energy, whatever the tissue's shape, because its one pressure term is the
// gradient of the density share and the spring that of a potential: kinetic + elastic + spring, by t = 100 dx/c0. All pairs,
// double.
#include <vector>

#include "tests/unit/tissue/tissue_fixture.h"

namespace bleedsim::sph {
namespace {

constexpr int kAcross = 8;
constexpr double kSoundSpeed = 3.0;  // m/s
constexpr double kSpeed = 0.3;       // m/s, of the initial swirl

struct Vessel {
  std::string name;
  std::vector<TissueDescription> tissue;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name is GoogleTest's
void PrintTo(const Vessel& one, std::ostream* out) { *out << one.name; }

class Blood {
 public:
  Blood(const Vessel& vessel, double support_ratio)
      : settings_{settingsFor(support_ratio)}, field_{fieldOf<double>(vessel.tissue, support_ratio)} {
    const double side = kAcross * kSpacing;
    for (int cell = 0; cell < kAcross * kAcross * kAcross; ++cell) {
      const int row = cell / kAcross;
      const int layer = row / kAcross;
      const Vec3 at = kSpacing * Vec3(cell % kAcross + 0.5, row % kAcross + 0.5, layer + 0.5);
      if (field_.distance(at.x(), at.y(), at.z()) < 0.25 * kSpacing) continue;
      const double x = at.x() / side * std::numbers::pi;
      const double z = at.z() / side * std::numbers::pi;
      position_.push_back(at);
      velocity_.push_back(kSpeed * Vec3(std::sin(x) * std::cos(z), 0.0, -std::cos(x) * std::sin(z)));
    }
    for (const TissueDescription& tissue : vessel.tissue) {
      const auto* box = std::get_if<BoxShape>(&tissue.shape);
      if (box == nullptr || box->obstacle) {
        springs_.push_back(tissue.shape);
        continue;
      }
      for (const PlaneShape& face : containerFaces(*box)) springs_.emplace_back(face);
    }
    act();
  }

  std::size_t size() const { return position_.size(); }

  void step(double dt) {
    for (std::size_t i = 0; i < size(); ++i) {
      velocity_[i] += 0.5 * dt * acceleration_[i];
      position_[i] += dt * velocity_[i];
    }
    act();
    for (std::size_t i = 0; i < size(); ++i) velocity_[i] += 0.5 * dt * acceleration_[i];
  }

  double energy() const {
    double sum = 0.0;  // over the mass of a particle
    for (std::size_t i = 0; i < size(); ++i) {
      sum += 0.5 * velocity_[i].squaredNorm();
      const double ratio = density_[i] / kRestDensity;
      if (ratio > 1.0) sum += kSoundSpeed * kSoundSpeed * (std::log(ratio) + 1.0 / ratio - 1.0);
      for (const TissueShape& shape : springs_) {
        const double depth = std::max(0.0, 0.5 - signedDistance(shape, position_[i]).value / kSpacing);
        sum += 0.5 * kSoundSpeed * kSoundSpeed * depth * depth;
      }
    }
    return sum;
  }

  double lowest() const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& at : position_) nearest = std::min(nearest, field_.distance(at.x(), at.y(), at.z()));
    return nearest / kSpacing;
  }

 private:
  void act() {
    const double mass = settings_.particle_mass;
    const SmoothingKernel& kernel = settings_.kernel;
    density_.assign(size(), mass * kernel.value(0.0));
    acceleration_.assign(size(), Vec3::Zero());
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < size(); ++i) {
      for (std::size_t j = i + 1; j < size(); ++j) {
        const double squared = (position_[i] - position_[j]).squaredNorm();
        if (squared >= kernel.h * kernel.h) continue;
        pairs.emplace_back(i, j);
        density_[i] += mass * kernel.value(std::sqrt(squared));
        density_[j] += mass * kernel.value(std::sqrt(squared));
      }
    }
    std::vector<double> pressure(size());  // p/rho^2
    for (std::size_t i = 0; i < size(); ++i) {
      WallSample<double> wall;
      const bool touched = field_.sample(position_[i].x(), position_[i].y(), position_[i].z(), wall);
      if (touched) density_[i] += kRestDensity * wall.share;
      pressure[i] = kSoundSpeed * kSoundSpeed * std::max(0.0, density_[i] - kRestDensity) / (density_[i] * density_[i]);
      if (!touched) continue;
      for (int axis = 0; axis < 3; ++axis) {
        acceleration_[i][axis] = kSoundSpeed * kSoundSpeed * wall.spring[axis] - kRestDensity * pressure[i] * wall.gradient[axis];
      }
    }
    for (const auto& [i, j] : pairs) {
      const Vec3 apart = position_[i] - position_[j];
      const double distance = apart.norm();
      const Vec3 push = mass * (pressure[i] + pressure[j]) * kernel.slope(distance) / distance * apart;
      acceleration_[i] -= push;
      acceleration_[j] += push;
    }
  }

  ShareSettings settings_;
  TissueField<double> field_;
  std::vector<TissueShape> springs_;  ///< one for each wall that pushes by itself
  std::vector<Vec3> position_, velocity_, acceleration_;
  std::vector<double> density_;
};

class TissueEnergyTest : public testing::TestWithParam<Vessel> {};

TEST_P(TissueEnergyTest, isKept) {
  for (const double support_ratio : {2.0, 2.5}) {
    Blood blood{GetParam(), support_ratio};
    ASSERT_GT(blood.size(), 50u);
    const double before = blood.energy();
    const double dt = 0.4 * kSpacing / (kSoundSpeed + 2.0 * kSpeed);
    const int steps = static_cast<int>(100.0 * kSpacing / kSoundSpeed / dt);
    double lowest = blood.lowest();
    for (int step = 0; step < steps; ++step) {
      blood.step(dt);
      if (step % 10 == 0) lowest = std::min(lowest, blood.lowest());
    }
    EXPECT_NEAR(blood.energy() / before, 1.0, 0.01) << support_ratio;
    EXPECT_GT(lowest, 0.0) << support_ratio;
  }
}

std::vector<Vessel> vessels() {
  const double dx = kSpacing;
  const double side = kAcross * dx;
  const TissueDescription box = tissueOf(BoxShape{.upper = Vec3::Constant(side)});
  const TissueDescription block =
      tissueOf(BoxShape{.lower = {2 * dx, 2 * dx, -5 * dx}, .upper = {6 * dx, 6 * dx, 3 * dx}, .obstacle = true});
  const TissueDescription bowl =
      tissueOf(BowlShape{.rim_center = {0.5 * side, 0.5 * side, 3 * dx}, .sphere_radius = 5 * dx, .depth = 3 * dx});
  const TissueDescription slope = tissueOf(PlaneShape{.point = {0.5 * side, 0, 0}, .normal = {-std::sqrt(0.75), 0, 0.5}});
  return {{"box", {box}}, {"boxAndBlock", {box, block}}, {"boxAndBowl", {box, bowl}}, {"boxAndSlope", {box, slope}}};
}

INSTANTIATE_TEST_SUITE_P(vessels, TissueEnergyTest, testing::ValuesIn(vessels()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bleedsim::sph
