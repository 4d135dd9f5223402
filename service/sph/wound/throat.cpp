#include "service/sph/wound/throat.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace bleedsim::sph {
namespace {

/// (1 - q)^4 (1 + 4 q), the two-dimensional Wendland C2 without its norm 7 / (pi h^2).
double lateralKernel(double q) {
  const double rest = 1.0 - q;
  const double squared = rest * rest;
  return q < 1.0 ? squared * squared * (1.0 + 4.0 * q) : 0.0;
}

/// Smallest kernel sum over a full square lattice, so that the opening is 1 everywhere well inside.
double smallestLatticeSum(double spacing, double support_radius) {
  const int reach = static_cast<int>(std::ceil(support_radius / spacing)) + 1;
  constexpr int kSamples = 4;
  double smallest = std::numeric_limits<double>::infinity();
  for (int a = 0; a <= kSamples; ++a) {
    for (int b = 0; b <= a; ++b) {
      double sum = 0.0;
      for (int i = -reach; i <= reach; ++i) {
        for (int j = -reach; j <= reach; ++j) {
          sum += lateralKernel(spacing / support_radius * std::hypot(i - 0.5 * a / kSamples, j - 0.5 * b / kSamples));
        }
      }
      smallest = std::min(smallest, sum);
    }
  }
  return smallest;
}

/// A step through the ranks near the golden ratio that visits every site: neighbours fire far apart in time.
std::uint64_t spreadingStride(std::uint64_t count) {
  auto stride =
      std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::round(static_cast<double>(count) / std::numbers::phi)));
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

}  // namespace

Throat::Throat(std::uint32_t slot, const PatchFrame& frame, const PatchSites& patch, double spacing, double support_radius,
               const Start& start)
    : slot_{slot},
      frame_{frame},
      area_{patch.area},
      gap_{patch.gap},
      depth_{support_radius + std::min(patch.gap, kDenseGap * spacing)},
      release_height_{kReleaseHeight * spacing},
      support_radius_{support_radius},
      height_per_particle_{patch.gap / static_cast<double>(patch.sites.size())},
      sparse_{patch.gap > kDenseGap * spacing * (1.0 + 1e-9)},
      column_{start.head_start},
      site_of_rank_(patch.sites.size()),
      rank_of_site_(patch.sites.size()),
      holes_(patch.sites.size(), 0),
      holes_before_(patch.sites.size(), 0) {
  assert(start.head_start >= 0.0 && start.head_start < 1.0);
  assert(start.ceilings.empty() || start.ceilings.size() == patch.sites.size());
  double extent = 0.0;
  for (const Vec2& site : patch.sites) extent = std::max(extent, site.norm());
  grid_ = SiteGrid{extent + spacing, support_radius};
  for (const Vec2& site : patch.sites) grid_.insert(site);
  reach_ = std::hypot(extent + support_radius, std::max(depth_, support_radius));
  opening_weight_ = 1.0 / smallestLatticeSum(spacing, support_radius);

  const std::uint64_t count = patch.sites.size();
  const std::uint64_t stride = spreadingStride(count);
  for (std::uint64_t site = 0; site < count; ++site) site_of_rank_[site * stride % count] = static_cast<std::uint32_t>(site);
  if (!start.ceilings.empty()) {
    std::stable_sort(site_of_rank_.begin(), site_of_rank_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return start.ceilings[a] > start.ceilings[b]; });
  }
  for (std::uint64_t rank = 0; rank < count; ++rank) rank_of_site_[site_of_rank_[rank]] = static_cast<std::uint32_t>(rank);
}

std::uint64_t Throat::enteringBound() const {
  return static_cast<std::uint64_t>(std::floor(column_ + depth_ / height_per_particle_));
}

InletStep Throat::countCrossings() {
  InletStep step;
  const auto due = static_cast<std::uint64_t>(std::floor(column_));
  for (; crossed_ < due; ++crossed_) {
    if (!isHole(crossed_)) {
      ++step.emitted;
      continue;
    }
    ++step.refused;
    keepHoles();
    const std::uint64_t count = holes_.size();
    holes_[site_of_rank_[crossed_ % count]] &= ~(std::uint64_t{1} << (crossed_ / count % 64));
  }
  return step;
}

double Throat::heightOf(std::uint64_t ordinal) const {
  return (column_ - static_cast<double>(ordinal + 1)) * height_per_particle_;
}

std::uint32_t Throat::tagOf(std::uint64_t ordinal) const {
  const std::uint64_t count = holes_.size();
  return packInletTag(
      {.slot = slot_, .site = site_of_rank_[ordinal % count], .serial = static_cast<std::uint32_t>(ordinal / count % 64)});
}

std::uint64_t Throat::ordinalOf(const InletTag& tag) const {
  assert(tag.slot == slot_ && tag.site < rank_of_site_.size());
  // Particles in use have serials from a few below that of the newest to cross to the deepest: 64 hold them all.
  const std::uint64_t count = holes_.size();
  const std::uint64_t newest = entered_ / count;
  const std::uint64_t serial = newest - ((newest - tag.serial) & 63u);
  return serial * count + rank_of_site_[tag.site];
}

InletState Throat::stateOf(std::uint64_t ordinal) const {
  const double height = heightOf(ordinal);
  const Vec2& site = sites()[site_of_rank_[ordinal % holes_.size()]];
  const InletPhase phase = height < 0.0               ? InletPhase::throat
                           : height < release_height_ ? InletPhase::emerging
                                                      : InletPhase::released;
  return {.position = frame_.toWorld(site, height), .velocity = columnSpeed() * frame_.normal, .phase = phase};
}

/// Only a world at capacity has holes, so they are not copied in every step.
void Throat::keepHoles() {
  if (holes_kept_) return;
  std::copy(holes_.begin(), holes_.end(), holes_before_.begin());
  holes_kept_ = true;
}

void Throat::rewind() {
  column_ = before_.column;
  entered_ = before_.entered;
  crossed_ = before_.crossed;
  if (holes_kept_) holes_.swap(holes_before_);
  holes_kept_ = false;
}

void Throat::makeHole(std::uint64_t ordinal) {
  keepHoles();
  const std::uint64_t count = holes_.size();
  holes_[site_of_rank_[ordinal % count]] |= std::uint64_t{1} << (ordinal / count % 64);
}

bool Throat::isHole(std::uint64_t ordinal) const {
  const std::uint64_t count = holes_.size();
  return (holes_[site_of_rank_[ordinal % count]] >> (ordinal / count % 64) & 1u) != 0;
}

std::uint64_t Throat::unseen() const {
  std::uint64_t particles = 0;
  for (std::uint64_t j = crossed_; j < entered_; ++j) particles += isHole(j) ? 0 : 1;
  return particles;
}

double Throat::openFraction(const Vec3& local) const {
  if (sparse_ || entered_ == 0 || local.z() > support_radius_ || local.z() < -depth_) return 0.0;
  double sum = 0.0;
  grid_.forEachNear({local.x(), local.y()}, [&](std::uint32_t site, double squared) {
    if (holes_[site] == 0) sum += lateralKernel(std::sqrt(squared) / support_radius_);
  });
  return std::min(1.0, sum * opening_weight_);
}

}  // namespace bleedsim::sph
