#include "service/lab/torture/torture_plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

#include "service/lab/dice.h"
#include "service/lab/torture/random_effects.h"

namespace bleedsim::lab {
namespace {

using scene::Scene;

void set(scene::Vec3& message, const sph::Vec3& v) {
  message.set_x(v.x());
  message.set_y(v.y());
  message.set_z(v.z());
}

/// Makes the scene from the ground up: what is drawn early bounds what comes later.
class Maker {
 public:
  Maker(Dice& dice, TorturePlan& plan) : dice_{dice}, plan_{plan}, scene_{plan.scene} {}

  void make() {
    scene_.set_name("torture");
    scene_.set_seed(1 + dice_.bits() % 1000);
    makeDomain();
    makeTissue();
    makeBlocks();
    addRandomEffects(dice_, literal(), scene_);
    makeWounds();
    makeCommands();
    if (dice_.chance(0.1)) scene_.set_max_dt_s(dice_.overMagnitudes(1e-7, 1e-3));
    // Last, so that what a seed has brought before stays.
    makeChanges();
  }

 private:
  bool literal() const { return scene_.model() == Scene::LITERAL; }

  void makeDomain() {
    dx_ = dice_.overMagnitudes(2e-4, 5e-3);
    for (int axis = 0; axis < 3; ++axis) half_[axis] = dx_ * (10 + dice_.upTo(14));
    scene::Domain& domain = *scene_.mutable_domain();
    set(*domain.mutable_lower_m(), -half_);
    set(*domain.mutable_upper_m(), half_);
    domain.set_periodic_x(dice_.chance(0.15));
    domain.set_periodic_y(dice_.chance(0.15));
    domain.set_capacity(static_cast<std::uint32_t>(kMostSeeded + dice_.upTo(600)));
    scene::Resolution& resolution = *scene_.mutable_resolution();
    resolution.set_spacing_m(dx_);
    if (dice_.chance(0.6)) resolution.set_support_ratio(dice_.chance(0.5) ? 2.5 : dice_.between(1.8, 3.2));
    scene::Compressibility& c = *scene_.mutable_compressibility();
    design_ = dice_.overMagnitudes(0.02, 3.0);
    c.set_design_speed_m_per_s(design_);
    if (dice_.chance(0.4)) c.set_mach_factor(dice_.between(5.0, 20.0));
    c.set_max_fall_or_depth_m(dice_.chance(0.7) ? 2.0 * half_.z() : 0.0);
    if (dice_.chance(0.2)) scene_.mutable_fluid()->set_density_kg_per_m3(dice_.between(600.0, 4000.0));
  }

  void makeTissue() {
    lower_ = -half_ + sph::Vec3::Constant(dx_);
    upper_ = half_ - sph::Vec3::Constant(dx_);
    const int kind = dice_.upTo(5);
    if (kind == 0) return;
    scene::Tissue& tissue = *scene_.add_tissue();
    tissue.set_name("tissue");
    if (dice_.chance(0.3)) tissue.set_slip(dice_.part());
    if (kind == 1) {
      makeContainer(*tissue.mutable_box());
    } else if (kind == 2) {
      scene::BowlTissue& bowl = *tissue.mutable_bowl();
      bowl.mutable_rim_center_m();
      const double radius = dx_ * dice_.between(5.0, 14.0);
      bowl.set_sphere_radius_m(radius);
      bowl.set_depth_m(radius * dice_.between(0.2, 1.0));
      lower_.z() = 0.0;
    } else {
      makePlane(*tissue.mutable_plane());
      if (kind == 5) makeObstacle();
    }
  }

  void makeContainer(scene::BoxTissue& box) {
    const sph::Vec3 inset = dice_.within(sph::Vec3::Constant(dx_), sph::Vec3::Constant(5.0 * dx_));
    lower_ = -half_ + inset;
    upper_ = half_ - inset;
    set(*box.mutable_lower_m(), lower_);
    set(*box.mutable_upper_m(), upper_);
    box.set_open_top(dice_.chance(0.5));
  }

  /// Through the origin, tilted by up to 25 degrees; blood starts above its highest point.
  void makePlane(scene::PlaneTissue& plane) {
    const double tilt = dice_.chance(0.4) ? dice_.between(0.0, 25.0) * std::numbers::pi / 180.0 : 0.0;
    normal_ = {std::sin(tilt), 0.0, std::cos(tilt)};
    plane.mutable_point_m();
    set(*plane.mutable_normal(), normal_);
    lower_.z() = std::tan(tilt) * half_.x();
    upper_.z() = std::max(upper_.z(), lower_.z() + 4.0 * dx_);
  }

  /// A block of tissue on the plane, under the blood.
  void makeObstacle() {
    scene::Tissue& tissue = *scene_.add_tissue();
    tissue.set_name("obstacle");
    scene::BoxTissue& box = *tissue.mutable_box();
    const double height = dx_ * dice_.between(1.0, 4.0);
    const double across = dx_ * dice_.between(2.0, 6.0);
    set(*box.mutable_lower_m(), {-across, -across, -2.0 * dx_});
    set(*box.mutable_upper_m(), {across, across, height});
    box.set_side(scene::BoxTissue::OBSTACLE);
    lower_.z() = std::max(lower_.z(), height);
  }

  /// Side by side along x, so that they never overlap, with as many particles as the capacity is sure to hold.
  void makeBlocks() {
    double x = lower_.x();
    int left = kMostSeeded;
    const int blocks = 1 + dice_.upTo(3);
    for (int k = 0; k < blocks; ++k) {
      sph::Vec3 size;
      for (int axis = 0; axis < 3; ++axis) size[axis] = (1 + dice_.upTo(8)) * dx_;
      const auto count = static_cast<int>(std::lround(size.prod() / (dx_ * dx_ * dx_)));
      const double y = lower_.y() + dice_.part() * (upper_.y() - lower_.y() - size.y());
      const double z = lower_.z() + (dice_.chance(0.5) ? 0.0 : dice_.part()) * (upper_.z() - lower_.z() - size.z());
      if (count > left || x + size.x() > upper_.x() || y < lower_.y() || z < lower_.z() || z + size.z() > upper_.z()) continue;
      left -= count;
      scene::FluidBlock& block = *scene_.add_fluid_blocks();
      set(*block.mutable_lower_m(), {x, y, z});
      set(*block.mutable_upper_m(), sph::Vec3{x, y, z} + size * (1.0 + 1e-9));
      x += size.x() + dx_ * dice_.between(0.01, 3.0);
      if (dice_.chance(0.6)) set(*block.mutable_velocity_m_per_s(), velocity());
      if (dice_.chance(0.4)) block.set_jitter(dice_.between(0.0, 0.2));
    }
  }

  /// Mostly of the scene's design speed, sometimes far beyond it.
  sph::Vec3 velocity() {
    const double speed = dice_.chance(0.1) ? std::min(50.0, 100.0 * design_) : 1.5 * design_;
    return dice_.within(sph::Vec3::Constant(-speed), sph::Vec3::Constant(speed)) / std::sqrt(3.0);
  }

  /// On planes and floors only, clear of obstacles.
  void makeWounds() {
    if (scene_.tissue_size() == 0) return;
    const scene::Tissue& tissue = scene_.tissue(0);
    if (tissue.has_bowl() || scene_.tissue_size() > 1) return;
    const int wounds = dice_.upTo(2);
    for (int k = 0; k < wounds; ++k) {
      scene::Wound& wound = *scene_.add_wounds();
      wound.set_name("wound" + std::to_string(k));
      const double radius = dx_ * dice_.between(0.4, 3.0);
      // Clear of a container's sides: a scene whose patch reaches into other tissue is refused as a whole.
      const double room_x = std::max(0.0, std::min(upper_.x(), -lower_.x()) - radius - dx_);
      const double room_y = std::max(0.0, std::min(upper_.y(), -lower_.y()) - radius - dx_);
      const double x = (k == 0 ? -0.5 : 0.5) * room_x;
      const double y = dice_.between(-0.9, 0.9) * room_y;
      const double floor = tissue.has_box() ? lower_.z() : -x * normal_.x() / normal_.z();
      set(*wound.mutable_position_m(), {x, y, floor});
      set(*wound.mutable_normal(), normal_);
      if (dice_.chance(0.7)) {
        wound.mutable_disc()->set_radius_m(radius);
      } else {
        wound.mutable_ellipse()->set_semi_axis_u_m(radius);
        wound.mutable_ellipse()->set_semi_axis_v_m(radius * dice_.between(0.3, 1.0));
      }
      if (dice_.chance(0.8)) {
        const double area = std::numbers::pi * radius * radius;
        wound.set_flow_ml_per_s(1e6 * area * design_ * dice_.between(0.0, 0.3));
      } else {
        wound.mutable_pressure()->set_inlet_pressure_mmhg(dice_.between(0.0, 20.0));
      }
    }
  }

  static bool earlier(const TimedCommand& a, const TimedCommand& b) { return a.step < b.step; }

  void makeCommands() {
    const int commands = dice_.upTo(6);
    for (int k = 0; k < commands; ++k) plan_.commands.push_back({dice_.upTo(std::max(1, plan_.steps - 1)), command()});
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const int limits = dice_.upTo(2);
    for (int k = 0; k < limits; ++k) {
      const double limit = dice_.chance(0.2) ? (dice_.chance(0.5) ? kNan : -1.0) : dice_.overMagnitudes(1e-9, 1.0);
      plan_.limits.push_back({dice_.upTo(std::max(1, plan_.steps - 1)), limit});
    }
    // Last, so that what a seed has brought before stays.
    const int wounds = onAPlane() ? dice_.upTo(2) : 0;
    for (int k = 0; k < wounds; ++k) plan_.commands.push_back({dice_.upTo(std::max(1, plan_.steps - 1)), newWound()});
    std::stable_sort(plan_.commands.begin(), plan_.commands.end(), earlier);
  }

  void makeChanges() {
    std::vector<int> steps(static_cast<std::size_t>(dice_.upTo(4)));
    for (int& step : steps) step = dice_.upTo(std::max(1, plan_.steps - 1));
    std::sort(steps.begin(), steps.end());
    scene::Effects effects = scene_.effects();
    for (const int step : steps) plan_.changes.push_back({step, randomChange(dice_, scene_, effects)});
  }

  sph::Command command() {
    const double kind = dice_.part();
    if (kind < 0.55) return force();
    if (kind < 0.65) return sph::RemoveForce{static_cast<sph::ForceKey>(1 + dice_.upTo(2))};
    if (kind < 0.75) return sph::RemoveWound{static_cast<std::uint32_t>(1 + dice_.upTo(1))};
    sph::UpdateWound update;
    update.wound_id = static_cast<std::uint32_t>(1 + dice_.upTo(1));
    if (dice_.chance(0.5)) update.drive = sph::FlowDrive{dice_.overMagnitudes(1e-12, 1e-5)};
    if (onAPlane() && dice_.chance(0.4)) moveWound(update);
    if (dice_.chance(0.2)) update.shape = sph::DiscPatch{dx_ * dice_.between(0.3, 3.0)};
    if (dice_.chance(0.1)) update.position = sph::Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    return update;
  }

  bool onAPlane() const { return scene_.tissue_size() == 1 && scene_.tissue(0).has_plane(); }
  struct Place {
    sph::Vec3 position;
    sph::Vec3 normal;
  };
  /// On the plane; inside it or turned into it, which must be refused, a quarter of the time each.
  Place placeForWound() {
    const sph::Vec3 part = dice_.within(sph::Vec3::Constant(-1.0), sph::Vec3::Constant(1.0));
    const sph::Vec3 at = 0.7 * part.cwiseProduct(half_);
    Place place{{at.x(), at.y(), -at.x() * normal_.x() / normal_.z()}, normal_};
    if (part.z() < -0.5) place.position += part.z() * 2.0 * dx_ * normal_;
    if (part.z() > 0.5) place.normal = -normal_;
    return place;
  }
  void moveWound(sph::UpdateWound& update) {
    const Place place = placeForWound();
    update.position = place.position;
    if (place.normal != normal_) update.normal = place.normal;
  }
  sph::AddWound newWound() {
    const Place place = placeForWound();
    const double radius = dx_ * dice_.between(0.4, 3.0);
    sph::AddWound add;
    add.wound.position = place.position;
    add.wound.normal = place.normal;
    add.wound.shape = sph::DiscPatch{radius};
    add.wound.drive = sph::FlowDrive{std::numbers::pi * radius * radius * design_ * dice_.between(0.0, 0.3)};
    return add;
  }

  /// A millionth of a newton to a thousand of them; sometimes no number.
  sph::SetForce force() {
    sph::SetForce force;
    force.key = static_cast<sph::ForceKey>(1 + dice_.upTo(2));
    force.position = dice_.within(-half_, half_);
    force.radius = dx_ * dice_.overMagnitudes(0.5, 12.0);
    const sph::Vec3 direction = dice_.within(sph::Vec3::Constant(-1.0), sph::Vec3::Constant(1.0));
    force.force = dice_.overMagnitudes(1e-6, 1e3) * direction;
    if (dice_.chance(0.3)) force.until = dice_.overMagnitudes(1e-6, 1e-1);
    if (dice_.chance(0.05)) force.force.x() = std::numeric_limits<double>::infinity();
    return force;
  }

  static constexpr int kMostSeeded = 700;

  Dice& dice_;
  TorturePlan& plan_;
  Scene& scene_;
  double dx_ = 0.0;                        // m
  double design_ = 0.0;                    // m/s
  sph::Vec3 half_ = sph::Vec3::Zero();     // of the domain, m
  sph::Vec3 lower_, upper_;                // where blood may start, m
  sph::Vec3 normal_ = sph::Vec3::UnitZ();  // of the tissue that wounds are in
};

}  // namespace

TorturePlan makePlan(std::uint64_t seed, scene::Scene::Model model, int steps) {
  Dice dice{seed};
  TorturePlan plan;
  plan.seed = seed;
  plan.steps = steps;
  plan.scene.set_model(model);
  plan.precision = dice.chance(0.3) ? sph::Precision::float64 : sph::Precision::float32;
  Maker{dice, plan}.make();
  return plan;
}

std::uint64_t particlesOf(const TorturePlan& plan) {
  double sum = 0.0;
  const double dx = plan.scene.resolution().spacing_m();
  for (const scene::FluidBlock& block : plan.scene.fluid_blocks()) {
    sum += (block.upper_m().x() - block.lower_m().x()) * (block.upper_m().y() - block.lower_m().y()) *
           (block.upper_m().z() - block.lower_m().z()) / (dx * dx * dx);
  }
  return static_cast<std::uint64_t>(std::lround(sum));
}

}  // namespace bleedsim::lab
