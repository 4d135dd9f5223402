#include "service/lab/bench/census.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "service/sph/neighbors/cell_grid.h"
#include "service/sph/world_setup.h"

namespace bleedsim::lab {
namespace {

using Point = std::array<float, 3>;

struct Near {
  Point at;
  float radius;
};

struct Sums {
  double neighbors = 0.0, listed = 0.0, candidates = 0.0, boxed = 0.0, surface = 0.0;
};

class Counter {
 public:
  explicit Counter(const sph::World& world)
      : scene_{world.description()},
        h_{scene_.supportRadius()},
        literal_{scene_.model == sph::Model::literal},
        own_radii_{scene_.effects.core_radius.has_value()} {
    const std::uint32_t attributes = own_radii_ ? std::uint32_t{sph::kFrameRadius} : 0;
    frame_.reserve(scene_.capacity, attributes);
    world.copyFrame(frame_, attributes);
    const auto& tension = scene_.effects.surface_tension;
    if (tension && !literal_) {
      volume_ = world.particleMass() / scene_.rest_density;
      cutoff_ = tension->normal_cutoff / h_;
    }
    sort();
  }

  Census count() {
    Sums sums;
    const auto& periodic = scene_.domain.periodic;
    if (periodic[0] || periodic[1] || periodic[2])
      walk<true>(sums);
    else
      walk<false>(sums);
    const double n = std::max(1U, frame_.count);
    return {frame_.count, sums.neighbors / n, sums.listed / n, sums.candidates / n, sums.boxed / n, sums.surface / n};
  }

 private:
  void sort() {
    std::array<double, 3> lower{};
    std::array<double, 3> upper{};
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = scene_.domain.lower[static_cast<Eigen::Index>(a)] / h_;
      upper[a] = scene_.domain.upper[static_cast<Eigen::Index>(a)] / h_;
    }
    for (std::uint32_t i = 0; own_radii_ && i < frame_.count; ++i)
      reach_ = std::max(reach_, frame_.radius[i] / static_cast<float>(h_));
    grid_ = sph::CellGrid<float>{std::max(1U, frame_.count),       lower, upper, scene_.domain.periodic, 1.0, 1,
                                 sph::radiusBounds(scene_).largest};
    sph::Bounds<float> bounds;
    const auto place = [this](std::uint32_t i) {
      Point point{};
      for (std::size_t a = 0; a < 3; ++a) point[a] = frame_.position[3 * std::size_t{i} + a] / static_cast<float>(h_);
      return point;
    };
    for (std::uint32_t i = 0; i < frame_.count; ++i) {
      const Point p = place(i);
      bounds.include(p[0], p[1], p[2]);
    }
    grid_.cover(bounds, reach_);
    for (std::uint32_t i = 0; i < frame_.count; ++i) {
      const Point p = place(i);
      grid_.cells()[i] = grid_.cellAt(p[0], p[1], p[2]);
    }
    points_.resize(frame_.count);
    radii_.assign(frame_.count, 1.0F);
    const auto executor = sph::makeExecutor(1);
    grid_.sort(frame_.count, 1, *executor, [&](std::uint32_t from, std::uint32_t to) {
      points_[to] = place(from);
      if (own_radii_) radii_[to] = frame_.radius[from] / static_cast<float>(h_);
    });
  }

  template <bool kPeriodic>
  void walk(Sums& sums) {
    const auto& view = grid_.view();
    for (int row = 0; row < view.rows(); ++row) {
      if (view.rowBegin(row) == view.rowEnd(row)) continue;
      for (int x = 1; x < view.size[0] - 1; ++x) {
        const std::size_t cell = view.cell(row, x);
        const std::uint32_t begin = view.start[cell];
        const std::uint32_t end = view.start[cell + 1];
        if (begin == end) continue;
        std::array<sph::NeighborRun<float>, sph::GridView<float>::kMaxRuns> runs;
        const int count = view.template neighborRuns<kPeriodic>(row, x, runs.data());
        sums.boxed += gather({runs.data(), static_cast<std::size_t>(count)}, begin, end);
        sums.candidates += static_cast<double>(near_.size()) * (end - begin);
        for (std::uint32_t i = begin; i < end; ++i) addParticle(i, sums);
      }
    }
  }

  /// Collects into near_ what is within reach of the box of a cell's particles; returns how many were looked at.
  std::uint32_t gather(std::span<const sph::NeighborRun<float>> runs, std::uint32_t begin, std::uint32_t end) {
    sph::Bounds<float> box;
    float largest = 1.0F;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.include(points_[i][0], points_[i][1], points_[i][2]);
      largest = std::max(largest, radii_[i]);
    }
    near_.clear();
    std::uint32_t seen = 0;
    for (const sph::NeighborRun<float>& run : runs) {
      seen += run.end - run.begin;
      for (std::uint32_t j = run.begin; j < run.end; ++j) {
        const Point p{points_[j][0] + run.shift_x, points_[j][1] + run.shift_y, points_[j][2] + run.shift_z};
        float square = 0.0F;
        for (std::size_t a = 0; a < 3; ++a) {
          const float off = std::max({box.lower[a] - p[a], p[a] - box.upper[a], 0.0F});
          square += off * off;
        }
        const float reach = literal_ ? reach_ : std::max(largest, radii_[j]);
        if (square < reach * reach) near_.push_back({p, radii_[j]});
      }
    }
    return seen;
  }

  void addParticle(std::uint32_t i, Sums& sums) const {
    const float own = radii_[i];
    sph::Vec3 normal = sph::Vec3::Zero();
    int neighbors = -1;  // the particle itself is near
    for (const Near& near : near_) {
      const Point d{near.at[0] - points_[i][0], near.at[1] - points_[i][1], near.at[2] - points_[i][2]};
      const float listed = std::max({1.0F, own, literal_ ? 1.0F : near.radius});
      const float square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (square < listed * listed) sums.listed += 1.0;
      if (square >= own * own) continue;
      ++neighbors;
      if (cutoff_ > 0.0) normal += gradientTowards(d, square);
    }
    sums.neighbors += neighbors;
    if (cutoff_ > 0.0 && volume_ * normal.norm() > cutoff_) sums.surface += 1.0;
  }

  /// grad W towards a neighbour, 1/m^4.
  sph::Vec3 gradientTowards(const Point& d, float square) const {
    const double q = std::sqrt(static_cast<double>(square));
    if (!(q > 0.0)) return sph::Vec3::Zero();
    return -kernel().slope(q * h_) / q *
           sph::Vec3{static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
  }
  sph::SmoothingKernel kernel() const { return scene_.densityKernel(); }

  const sph::WorldDescription& scene_;
  double h_;
  bool literal_;
  bool own_radii_;
  double volume_ = 0.0;  // m/rho0, m^3
  double cutoff_ = 0.0;  // of |n|, 1/m; 0 without curvature tension
  float reach_ = 1.0F;   // of lists, in support radii
  sph::FrameBuffer frame_;
  sph::CellGrid<float> grid_;
  std::vector<Point> points_;  // in cell order, in support radii
  std::vector<float> radii_;
  std::vector<Near> near_;
};

}  // namespace

Census takeCensus(const sph::World& world) { return Counter{world}.count(); }

}  // namespace bleedsim::lab
