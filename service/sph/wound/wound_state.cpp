// Wounds and their throats in a saved state. What follows from a wound's description, as its sites, is worked out again.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "service/sph/state_bytes.h"
#include "service/sph/wound/text.h"
#include "service/sph/wound/wound_set.h"

namespace bleedsim::sph {
namespace {

constexpr std::size_t kMaxNameLength = 256;
constexpr std::size_t kMaxPoints = 256;
constexpr double kMostParticles = 9e15;  // counts that a double still tells apart

Status damaged(const std::string& what) { return {StatusCode::data_loss, what}; }

void saveVector(const Vec3& v, StateWriter& out) {
  for (Eigen::Index a = 0; a < 3; ++a) out.value(v[a]);
}
Vec3 readVector(StateReader& in) {
  Vec3 v;
  for (Eigen::Index a = 0; a < 3; ++a) v[a] = in.value<double>();
  return v;
}

void savePoints(const std::vector<Vec2>& points, StateWriter& out) {
  out.value(static_cast<std::uint32_t>(points.size()));
  for (const Vec2& point : points) {
    out.value(point.x());
    out.value(point.y());
  }
}
std::vector<Vec2> readPoints(StateReader& in) {
  std::vector<Vec2> points(in.count(kMaxPoints, 2 * sizeof(double)));
  for (Vec2& point : points) {
    point.x() = in.value<double>();
    point.y() = in.value<double>();
  }
  return points;
}

struct ShapeSaver {
  StateWriter& out;

  void operator()(const DiscPatch& disc) const { out.value(disc.radius); }
  void operator()(const EllipsePatch& ellipse) const {
    out.value(ellipse.semi_axis_u);
    out.value(ellipse.semi_axis_v);
  }
  void operator()(const PolygonPatch& polygon) const { savePoints(polygon.points, out); }
  void operator()(const PolylinePatch& line) const {
    savePoints(line.points, out);
    out.value(line.width);
  }
};

PatchShape readShape(StateReader& in) {
  switch (in.value<std::uint32_t>()) {
    case 0:
      return DiscPatch{in.value<double>()};
    case 1: {
      const auto u = in.value<double>();
      return EllipsePatch{u, in.value<double>()};
    }
    case 2:
      return PolygonPatch{readPoints(in)};
    default: {
      std::vector<Vec2> points = readPoints(in);
      return PolylinePatch{std::move(points), in.value<double>()};
    }
  }
}

void saveDescription(const WoundDescription& wound, StateWriter& out) {
  out.text(wound.name);
  saveVector(wound.position, out);
  saveVector(wound.normal, out);
  saveVector(wound.tangent, out);
  out.value(static_cast<std::uint32_t>(wound.shape.index()));
  std::visit(ShapeSaver{out}, wound.shape);
  out.value(static_cast<std::uint32_t>(wound.drive.index()));
  if (const auto* flow = std::get_if<FlowDrive>(&wound.drive)) {
    out.value(flow->flow);
  } else {
    const auto& pressure = std::get<PressureDriveSettings>(wound.drive);
    out.value(pressure.inlet_pressure);
    out.value(pressure.discharge_coefficient);
  }
}

WoundDescription readDescription(StateReader& in) {
  WoundDescription wound;
  wound.name = in.text(kMaxNameLength);
  wound.position = readVector(in);
  wound.normal = readVector(in);
  wound.tangent = readVector(in);
  wound.shape = readShape(in);
  if (in.value<std::uint32_t>() == 0) {
    wound.drive = FlowDrive{in.value<double>()};
  } else {
    const auto pressure = in.value<double>();
    wound.drive = PressureDriveSettings{pressure, in.value<double>()};
  }
  return wound;
}

}  // namespace

void Throat::save(StateWriter& out) const {
  out.value(column_);
  out.value(entered_);
  out.value(crossed_);
  out.array(site_of_rank_.data(), site_of_rank_.size());
  out.array(holes_.data(), holes_.size());
}

Status Throat::restore(StateReader& in) {
  column_ = in.value<double>();
  entered_ = in.value<std::uint64_t>();
  crossed_ = in.value<std::uint64_t>();
  in.array(site_of_rank_.data(), site_of_rank_.size());
  in.array(holes_.data(), holes_.size());
  if (in.failed()) return damaged("the state ends within a wound's throat");
  if (!(column_ >= 0.0) || column_ > kMostParticles || crossed_ != static_cast<std::uint64_t>(std::floor(column_)) ||
      entered_ < crossed_ || entered_ > enteringBound()) {
    return damaged("a wound's column and its particles do not agree");
  }
  std::fill(rank_of_site_.begin(), rank_of_site_.end(), static_cast<std::uint32_t>(rank_of_site_.size()));
  for (std::size_t rank = 0; rank < site_of_rank_.size(); ++rank) {
    const std::uint32_t site = site_of_rank_[rank];
    if (site >= rank_of_site_.size() || rank_of_site_[site] != rank_of_site_.size()) {
      return damaged("the turns of a wound's sites are not one for each");
    }
    rank_of_site_[site] = static_cast<std::uint32_t>(rank);
  }
  return {};
}

bool Throat::mayDrive(const InletTag& tag) const {
  if (tag.slot != slot_ || tag.site >= rank_of_site_.size()) return false;
  const std::uint64_t count = holes_.size();
  const std::uint64_t newest = entered_ / count;
  const std::uint64_t back = (newest - tag.serial) & 63u;
  return back <= newest && (newest - back) * count + rank_of_site_[tag.site] < entered_;
}

void WoundSet::save(StateWriter& out) const {
  out.value(next_id_);
  out.value(emitted_);
  out.value(refused_);
  out.value(withdrawn_);
  out.value(commanded_);
  out.value(static_cast<std::uint32_t>(wounds_.size()));
  for (const Wound& wound : wounds_) {
    out.value(wound.id);
    out.value(wound.throat.slot());
    out.value(wound.emitted);
    saveDescription(wound.description, out);
    wound.throat.save(out);
  }
}

Status WoundSet::restore(StateReader& in) {
  next_id_ = in.value<std::uint32_t>();
  emitted_ = in.value<std::uint64_t>();
  refused_ = in.value<std::uint64_t>();
  withdrawn_ = in.value<std::uint64_t>();
  commanded_ = in.value<double>();
  const auto count = in.value<std::uint32_t>();
  if (in.failed()) return damaged("the state ends before its wounds");
  if (count > max_wounds_) return damaged(textOf("the state has ", count, " wounds, more than the scene's ", max_wounds_));
  if (!std::isfinite(commanded_)) return damaged("the ledger of the wounds is not finite");
  wounds_.clear();
  states_.clear();
  std::fill(wound_of_slot_.begin(), wound_of_slot_.end(), std::uint16_t{0});
  std::vector<bool> taken(max_wounds_ + 1, false);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (Status status = restoreOne(in, taken); !status.ok()) return status;
  }
  refreshReach();
  return {};
}

Status WoundSet::restoreOne(StateReader& in, std::vector<bool>& taken) {
  const auto id = in.value<std::uint32_t>();
  const auto slot = in.value<std::uint32_t>();
  const auto emitted = in.value<std::uint64_t>();
  WoundDescription description = readDescription(in);
  if (in.failed()) return damaged("the state ends within a wound");
  if (id == 0 || id >= next_id_ || (!wounds_.empty() && id <= wounds_.back().id)) {
    return damaged(textOf("wound id ", id, " is out of order"));
  }
  if (slot == 0 || slot > max_wounds_ || taken[slot]) return damaged(textOf("wound ", id, " has no place of its own"));
  taken[slot] = true;
  const auto refused = [id](const Status& why) { return damaged(textOf("wound ", id, ": ", why.message())); };
  if (Status status = checkNameAndDrive(description, id); !status.ok()) return refused(status);
  const Result<Opening> opening = planOpening(description);
  if (!opening) return refused(opening.status());
  Throat throat = rules_.open(slot, *opening);
  if (Status status = throat.restore(in); !status.ok()) return refused(status);
  const Result<double> rate = planRate(description, throat);
  if (!rate) return refused(rate.status());
  throat.setRate(*rate);
  wound_of_slot_[slot] = static_cast<std::uint16_t>(wounds_.size());
  wounds_.push_back({.id = id, .description = std::move(description), .throat = std::move(throat), .emitted = emitted});
  states_.push_back({.id = id, .emitted = static_cast<double>(emitted) * particle_volume_, .flow = *rate * particle_volume_});
  return {};
}

bool WoundSet::mayDrive(std::uint32_t tag) const {
  const InletTag parts = unpackInletTag(tag);
  if (parts.slot == 0 || parts.slot >= wound_of_slot_.size() || wound_of_slot_[parts.slot] >= wounds_.size()) return false;
  return wounds_[wound_of_slot_[parts.slot]].throat.mayDrive(parts);
}

}  // namespace bleedsim::sph
