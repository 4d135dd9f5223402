#include <fmt/core.h>
#include <string>

#include "service/dds/bounded_text.h"
#include "service/dds/decode.h"
#include "service/dds/value_check.h"
#include "service/status/units.h"

namespace bleedsim::dds {
namespace {

Result<std::vector<sph::Vec2>> decodeOutline(const dds_sequence_double& outline, std::size_t min_points) {
  if (outline._length % 2 != 0) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("wound.outline has {} numbers: use pairs of u and v", outline._length)};
  }
  const std::uint32_t count = outline._length / 2;
  if (count < min_points || count > kMaxPatchPoints || outline._buffer == nullptr) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("wound.outline has {} points: use {} to {}", count, min_points, kMaxPatchPoints)};
  }
  std::vector<sph::Vec2> points;
  points.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double* pair = outline._buffer + 2 * std::size_t{i};
    if (Status u = checkNumber(fmt::format("wound.outline[{}].u", i), pair[0], kPatchCoordinate); !u) return u;
    if (Status v = checkNumber(fmt::format("wound.outline[{}].v", i), pair[1], kPatchCoordinate); !v) return v;
    points.emplace_back(pair[0], pair[1]);
  }
  return points;
}

Result<sph::PatchShape> decodeShape(const bleed_v1_Wound& sample) {
  const auto length = [](std::string_view field, double value) { return checkNumber(field, value, kPatchLength); };
  switch (sample.shape) {
    case bleed_v1_SHAPE_DISC: {
      if (Status radius = length("wound.radius_m", sample.radius_m); !radius) return radius;
      return sph::PatchShape{sph::DiscPatch{sample.radius_m}};
    }
    case bleed_v1_SHAPE_ELLIPSE: {
      if (Status along = length("wound.radius_m", sample.radius_m); !along) return along;
      if (Status across = length("wound.radius2_m", sample.radius2_m); !across) return across;
      return sph::PatchShape{sph::EllipsePatch{sample.radius_m, sample.radius2_m}};
    }
    case bleed_v1_SHAPE_POLYGON: {
      Result<std::vector<sph::Vec2>> points = decodeOutline(sample.outline, kMinPolygonPoints);
      if (!points) return points.status();
      return sph::PatchShape{sph::PolygonPatch{std::move(*points)}};
    }
    case bleed_v1_SHAPE_POLYLINE: {
      if (Status width = length("wound.width_m", sample.width_m); !width) return width;
      Result<std::vector<sph::Vec2>> points = decodeOutline(sample.outline, kMinPolylinePoints);
      if (!points) return points.status();
      return sph::PatchShape{sph::PolylinePatch{std::move(*points), sample.width_m}};
    }
    default:
      return Status{StatusCode::invalid_argument,
                    fmt::format("wound.shape is {}: use 0 (disc), 1 (ellipse), 2 (polygon) or 3 (polyline)", sample.shape)};
  }
}

Result<sph::WoundDrive> decodeDrive(const bleed_v1_Wound& sample) {
  switch (sample.drive) {
    case bleed_v1_DRIVE_FLOW: {
      if (Status flow = checkNumber("wound.flow_ml_per_s", sample.flow_ml_per_s, kFlow); !flow) return flow;
      return sph::WoundDrive{sph::FlowDrive{cubicMetresFromMl(sample.flow_ml_per_s)}};
    }
    case bleed_v1_DRIVE_PRESSURE: {
      if (Status pressure = checkNumber("wound.pressure_mmhg", sample.pressure_mmhg, kInletPressure); !pressure) return pressure;
      const double coefficient = sample.discharge_coefficient;
      if (coefficient == 0.0) {
        return sph::WoundDrive{sph::PressureDriveSettings{pascalsFromMmHg(sample.pressure_mmhg), kDefaultDischargeCoefficient}};
      }
      if (Status discharge = checkNumber("wound.discharge_coefficient", coefficient, kDischargeOrDefault); !discharge) {
        return discharge;
      }
      return sph::WoundDrive{sph::PressureDriveSettings{pascalsFromMmHg(sample.pressure_mmhg), coefficient}};
    }
    default:
      return Status{StatusCode::invalid_argument, fmt::format("wound.drive is {}: use 0 (flow) or 1 (pressure)", sample.drive)};
  }
}

Result<std::string> decodeName(const bleed_v1_Wound& sample) {
  const std::string_view name = viewText(sample.name);
  if (Status label = checkLabel("wound.name", name); !label) return label;
  return std::string{name};
}

/// Zero lets the world choose the u axis.
Result<sph::Vec3> decodeTangent(const bleed_v1_Vec3& tangent) {
  if (tangent.x == 0.0 && tangent.y == 0.0 && tangent.z == 0.0) return sph::Vec3{sph::Vec3::Zero()};
  return checkDirection("wound.tangent", tangent);
}

}  // namespace

Result<sph::WoundDescription> decodeWound(const bleed_v1_Wound& sample) {
  Result<std::string> name = decodeName(sample);
  if (!name) return name.status();
  const Result<sph::Vec3> position = checkVector("wound.position", sample.position, kCoordinate);
  if (!position) return position.status();
  const Result<sph::Vec3> normal = checkDirection("wound.normal", sample.normal);
  if (!normal) return normal.status();
  const Result<sph::Vec3> tangent = decodeTangent(sample.tangent);
  if (!tangent) return tangent.status();
  Result<sph::PatchShape> shape = decodeShape(sample);
  if (!shape) return shape.status();
  const Result<sph::WoundDrive> drive = decodeDrive(sample);
  if (!drive) return drive.status();
  return sph::WoundDescription{std::move(*name), *position, *normal, *tangent, std::move(*shape), *drive};
}

Result<sph::UpdateWound> decodeWoundUpdate(const bleed_v1_WoundUpdate& sample) {
  constexpr std::uint32_t kAll = bleed_v1_WOUND_FIELD_POSITION | bleed_v1_WOUND_FIELD_NORMAL | bleed_v1_WOUND_FIELD_SHAPE |
                                 bleed_v1_WOUND_FIELD_DRIVE | bleed_v1_WOUND_FIELD_NAME;
  if (sample.fields == 0 || (sample.fields & ~kAll) != 0) {
    return Status{StatusCode::invalid_argument,
                  fmt::format("wound_update.fields is {}: name at least one of 1 (position), 2 (normal), 4 (shape), 8 (drive), "
                              "16 (name) and nothing else",
                              sample.fields)};
  }
  sph::UpdateWound update;
  update.wound_id = sample.wound_id;
  if ((sample.fields & bleed_v1_WOUND_FIELD_NAME) != 0) {
    Result<std::string> name = decodeName(sample.wound);
    if (!name) return name.status();
    update.name = std::move(*name);
  }
  if ((sample.fields & bleed_v1_WOUND_FIELD_POSITION) != 0) {
    const Result<sph::Vec3> position = checkVector("wound.position", sample.wound.position, kCoordinate);
    if (!position) return position.status();
    update.position = *position;
  }
  if ((sample.fields & bleed_v1_WOUND_FIELD_NORMAL) != 0) {
    const Result<sph::Vec3> normal = checkDirection("wound.normal", sample.wound.normal);
    if (!normal) return normal.status();
    const Result<sph::Vec3> tangent = decodeTangent(sample.wound.tangent);
    if (!tangent) return tangent.status();
    update.normal = *normal;
    update.tangent = *tangent;
  }
  if ((sample.fields & bleed_v1_WOUND_FIELD_SHAPE) != 0) {
    Result<sph::PatchShape> shape = decodeShape(sample.wound);
    if (!shape) return shape.status();
    update.shape = std::move(*shape);
  }
  if ((sample.fields & bleed_v1_WOUND_FIELD_DRIVE) != 0) {
    const Result<sph::WoundDrive> drive = decodeDrive(sample.wound);
    if (!drive) return drive.status();
    update.drive = *drive;
  }
  return update;
}

Result<std::string> decodeWoundName(const bleed_v1_RequestBody& body) {
  const auto either = [](std::uint32_t id, std::string_view name) -> Result<std::string> {
    if (name.empty()) return std::string{};
    if (id != 0) {
      return Status{StatusCode::invalid_argument,
                    fmt::format("wound_id is {} and wound_name is given: name the wound by one of them", id)};
    }
    if (Status label = checkLabel("wound_name", name); !label) return label;
    return std::string{name};
  };
  if (body._d == bleed_v1_REQUEST_WOUND_UPDATE) {
    return either(body._u.wound_update.wound_id, viewText(body._u.wound_update.wound_name));
  }
  if (body._d == bleed_v1_REQUEST_WOUND_REMOVE) {
    return either(body._u.wound_remove.wound_id, viewText(body._u.wound_remove.wound_name));
  }
  return std::string{};
}

}  // namespace bleedsim::dds
