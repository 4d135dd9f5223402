#include "service/sph/wound/wound_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "service/sph/wound/orifice.h"
#include "service/sph/wound/text.h"

namespace bleedsim::sph {
namespace {

constexpr std::size_t kMaxNameLength = 256;

Status invalid(std::string message) { return {StatusCode::invalid_argument, std::move(message)}; }

const char* nameOf(BuriedPatch::Fault fault) {
  switch (fault) {
    case BuriedPatch::Fault::position:
      return "position";
    case BuriedPatch::Fault::normal:
      return "normal";
    case BuriedPatch::Fault::extent:
      break;
  }
  return "patch";
}

}  // namespace

WoundSet::WoundSet(const WorldDescription& description, double speed_of_sound)
    : rules_{description, speed_of_sound},
      spacing_{description.spacing},
      particle_volume_{description.particleVolume()},
      max_wounds_{std::min(description.max_wounds, kMaxInletSlots)},
      wound_of_slot_(max_wounds_ + 1, 0) {
  wounds_.reserve(max_wounds_);
  states_.reserve(max_wounds_);
  reach_.reserve(max_wounds_);
}

Result<WoundSet::Addition> WoundSet::planAddition(const WoundDescription& wound) const {
  if (wounds_.size() >= max_wounds_) {
    return Status{StatusCode::capacity, textOf("there are already ", wounds_.size(), " wounds, the most that this scene allows ",
                                               "(max_wounds); remove one first or load a scene with more")};
  }
  if (Status status = checkNameAndDrive(wound, 0); !status) return status;
  Result<Opening> opening = planOpening(wound);
  if (!opening) return opening.status();
  Throat throat = rules_.open(freeSlot(), *opening);
  if (Status status = checkClear(throat, 0); !status) return status;
  const Result<double> rate = planRate(wound, throat);
  if (!rate) return rate.status();
  throat.setRate(*rate);
  return Addition{std::move(throat), *rate};
}

Result<std::uint32_t> WoundSet::add(const WoundDescription& wound) {
  Result<Addition> plan = planAddition(wound);
  if (!plan) return plan.status();
  const std::uint32_t id = next_id_++;
  wound_of_slot_[plan->throat.slot()] = static_cast<std::uint16_t>(wounds_.size());
  wounds_.push_back({.id = id, .description = wound, .throat = std::move(plan->throat)});
  states_.push_back({.id = id, .emitted = 0.0, .flow = plan->rate * particle_volume_});
  refreshReach();
  return id;
}

Result<WoundSet::Revision> WoundSet::planRevision(const UpdateWound& change) const {
  const std::size_t index = indexOf(change.wound_id);
  if (index == wounds_.size()) return unknown(change.wound_id);
  const Wound& wound = wounds_[index];
  WoundDescription next = wound.description;
  if (change.name) next.name = *change.name;
  if (change.position) next.position = *change.position;
  if (change.normal) next.normal = *change.normal;
  if (change.tangent) next.tangent = *change.tangent;
  if (change.shape) next.shape = *change.shape;
  if (change.drive) next.drive = *change.drive;

  if (Status status = checkNameAndDrive(next, wound.id); !status) return status;
  std::optional<Throat> reopened;
  const WoundDescription& now = wound.description;
  if (next.position != now.position || next.normal != now.normal || next.tangent != now.tangent || change.shape) {
    Result<Opening> opening = planOpening(next);
    if (!opening) return opening.status();
    reopened.emplace(rules_.open(wound.throat.slot(), *opening, startAfter(wound.throat, *opening)));
    if (Status status = checkClear(*reopened, wound.id); !status) return status;
  }
  const Result<double> rate = planRate(next, reopened ? *reopened : wound.throat);
  if (!rate) return rate.status();
  return Revision{index, std::move(next), std::move(reopened), *rate};
}

Status WoundSet::update(const UpdateWound& change, const WithdrawThroat& withdraw) {
  Result<Revision> plan = planRevision(change);
  if (!plan) return plan.status();
  Wound& wound = wounds_[plan->index];
  if (plan->reopened) {
    withdrawThroat(plan->index, withdraw);
    wound.throat = std::move(*plan->reopened);
  }
  wound.throat.setRate(plan->rate);
  wound.description = std::move(plan->description);
  states_[plan->index].flow = plan->rate * particle_volume_;
  refreshReach();
  return {};
}

Status WoundSet::check(const AddWound& change) const { return planAddition(change.wound).status(); }

Status WoundSet::check(const UpdateWound& change) const { return planRevision(change).status(); }

Status WoundSet::check(const RemoveWound& change) const {
  return indexOf(change.wound_id) == wounds_.size() ? unknown(change.wound_id) : Status{};
}

Status WoundSet::remove(std::uint32_t id, const WithdrawThroat& withdraw) {
  const std::size_t index = indexOf(id);
  if (index == wounds_.size()) return unknown(id);
  withdrawThroat(index, withdraw);
  wounds_.erase(wounds_.begin() + static_cast<std::ptrdiff_t>(index));
  states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(index));
  for (std::size_t i = index; i < wounds_.size(); ++i) wound_of_slot_[wounds_[i].throat.slot()] = static_cast<std::uint16_t>(i);
  refreshReach();
  return {};
}

InletState WoundSet::kinematics(std::uint32_t tag) const {
  const InletTag parts = unpackInletTag(tag);
  assert(parts.slot >= 1 && parts.slot < wound_of_slot_.size() && wound_of_slot_[parts.slot] < wounds_.size());
  InletState state = wounds_[wound_of_slot_[parts.slot]].throat.kinematics(parts);
  wrapInto(rules_.domain(), state.position);
  return state;
}

bool WoundSet::mayOpen(const Vec3& lower, const Vec3& upper) const {
  const Vec3 center = 0.5 * (lower + upper);
  const double radius = (upper - center).norm();
  for (std::size_t i = 0; i < wounds_.size(); ++i) {
    const Vec3 offset = nearestOffset(rules_.domain(), wounds_[i].throat.frame().origin, center);
    const double reach = reach_[i] + radius;
    if (reach_[i] > 0.0 && offset.squaredNorm() < reach * reach) return true;
  }
  return false;
}

double WoundSet::openFraction(const Vec3& position) const {
  double open = 0.0;
  for (std::size_t i = 0; i < wounds_.size(); ++i) {
    const PatchFrame& frame = wounds_[i].throat.frame();
    const Vec3 offset = nearestOffset(rules_.domain(), frame.origin, position);
    if (offset.squaredNorm() < reach_[i] * reach_[i]) open += wounds_[i].throat.openFraction(frame.toLocal(offset));
  }
  return std::min(1.0, open);
}

const WoundDescription* WoundSet::description(std::uint32_t id) const {
  const std::size_t index = indexOf(id);
  return index == wounds_.size() ? nullptr : &wounds_[index].description;
}

const Throat* WoundSet::throat(std::uint32_t id) const {
  const std::size_t index = indexOf(id);
  return index == wounds_.size() ? nullptr : &wounds_[index].throat;
}

double WoundSet::deepestThroat() const {
  double depth = 0.0;
  for (const Wound& wound : wounds_) depth = std::max(depth, wound.throat.depth());
  return depth;
}

std::size_t WoundSet::indexOf(std::uint32_t id) const {
  const auto found =
      std::lower_bound(wounds_.begin(), wounds_.end(), id, [](const Wound& a, std::uint32_t b) { return a.id < b; });
  return found != wounds_.end() && found->id == id ? static_cast<std::size_t>(found - wounds_.begin()) : wounds_.size();
}

Status WoundSet::unknown(std::uint32_t id) const {
  std::string known;
  for (std::size_t i = 0; i < std::min<std::size_t>(wounds_.size(), 16); ++i) known += textOf(i == 0 ? "" : ", ", wounds_[i].id);
  if (wounds_.size() > 16) known += ", ...";
  return {StatusCode::not_found,
          textOf("there is no wound ", id, "; ", wounds_.empty() ? "there are no wounds" : "the wounds now are " + known)};
}

Status WoundSet::checkNameAndDrive(const WoundDescription& wound, std::uint32_t except_id) const {
  if (wound.name.size() > kMaxNameLength) {
    return invalid(textOf("wound name has ", wound.name.size(), " bytes; at most ", kMaxNameLength, " are allowed"));
  }
  for (const Wound& other : wounds_) {
    if (wound.name.empty() || other.id == except_id || other.description.name != wound.name) continue;
    return invalid(
        textOf("wound name '", wound.name, "' is already that of wound ", other.id, "; give each wound its own or none"));
  }
  return checkDrive(wound.drive);
}

Result<Opening> WoundSet::planOpening(const WoundDescription& wound) const {
  Result<Opening> opening = rules_.plan(wound);
  if (!opening) return opening;
  if (const auto outside = rules_.outside(*opening)) {
    const char axis = "xyz"[outside->axis];
    if (outside->lowest > outside->highest) {
      return invalid(textOf("wound patch reaches out of the domain on both sides along ", axis, "; make it smaller"));
    }
    return invalid(textOf("wound position.", axis, " is ", wound.position[static_cast<Eigen::Index>(outside->axis)], ": use ",
                          outside->lowest, " to ", outside->highest, " m, or the patch reaches out of the domain"));
  }
  if (const auto meets_itself = rules_.meetsItself(*opening)) {
    return invalid(textOf("wound patch reaches ", meets_itself->extent,
                          " m from its position; on this scene's periodic side it may reach ", meets_itself->most,
                          " m, or it would meet itself"));
  }
  if (const auto buried = rules_.buried(*opening)) return invalid(textOf("wound ", nameOf(buried->fault), " ", buried->reason));
  return opening;
}

Throat::Start WoundSet::startAfter(const Throat& before, const Opening& opening) const {
  Throat::Start start{before.column() - std::floor(before.column()), std::vector<double>(opening.patch.sites.size(), 0.0)};
  const double separation = kSiteSeparation * spacing_;
  double extent = spacing_;
  for (const Vec2& site : opening.patch.sites) extent = std::max(extent, site.norm());
  SiteGrid grid{extent, spacing_};
  for (const Vec2& site : opening.patch.sites) grid.insert(site);
  before.forEachJustEmitted([&](const Vec3& position) {
    const Vec3 local = opening.frame.toLocal(nearestOffset(rules_.domain(), opening.frame.origin, position));
    grid.forEachNear({local.x(), local.y()}, [&](std::uint32_t site, double squared) {
      const double below = separation * separation - squared;
      if (below > 0.0) start.ceilings[site] = std::min(start.ceilings[site], local.z() - std::sqrt(below));
    });
  });
  return start;
}

Status WoundSet::checkClear(const Throat& candidate, std::uint32_t except_id) const {
  for (const Wound& wound : wounds_) {
    if (wound.id == except_id || !rules_.overlap(candidate, wound.throat)) continue;
    return invalid(textOf("wound at ", textOfPoint(candidate.frame().origin), " m overlaps wound ", wound.id, " at ",
                          textOfPoint(wound.throat.frame().origin), " m; keep their patches one spacing (", spacing_,
                          " m) apart, or change wound ", wound.id));
  }
  return {};
}

Result<double> WoundSet::planRate(const WoundDescription& wound, const Throat& throat) const {
  if (Status status = checkSpeed(rules_.columnSpeed(wound.drive, throat), wound.drive); !status) return status;
  return rules_.rateOf(wound.drive, throat);
}

std::uint32_t WoundSet::freeSlot() const {
  std::vector<bool> taken(max_wounds_ + 1, false);
  for (const Wound& wound : wounds_) taken[wound.throat.slot()] = true;
  std::uint32_t slot = 1;
  while (taken[slot]) ++slot;
  return slot;
}

void WoundSet::book(std::size_t index, const InletStep& step, double dt) {
  Wound& wound = wounds_[index];
  wound.emitted += step.emitted;
  emitted_ += step.emitted;
  refused_ += step.refused;
  commanded_ += states_[index].flow / particle_volume_ * dt;
  states_[index].emitted = static_cast<double>(wound.emitted) * particle_volume_;
}

void WoundSet::rewind() {
  for (std::size_t i = 0; i < wounds_.size(); ++i) {
    Wound& wound = wounds_[i];
    wound.throat.rewind();
    wound.emitted = wound.emitted_before;
    states_[i].emitted = static_cast<double>(wound.emitted) * particle_volume_;
  }
  emitted_ = before_.emitted;
  refused_ = before_.refused;
  commanded_ = before_.commanded;
}

void WoundSet::withdrawThroat(std::size_t index, const WithdrawThroat& withdraw) {
  const Throat& throat = wounds_[index].throat;
  if (withdraw) withdraw(throat);
  withdrawn_ += throat.unseen();
}

void WoundSet::refreshReach() {
  reach_.clear();
  for (const Wound& wound : wounds_) reach_.push_back(wound.throat.sparse() ? 0.0 : wound.throat.reach());
}

}  // namespace bleedsim::sph
