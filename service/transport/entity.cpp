#include "service/transport/entity.h"

#include <fmt/core.h>

namespace bleedsim::transport {

Result<Entity> Entity::adopt(dds_entity_t handle, std::string_view what) {
  if (handle < 0) return ddsStatus(handle, what);
  return Entity{handle};
}

Status ddsStatus(dds_return_t code, std::string_view what) {
  if (code >= 0) return {};
  const StatusCode kind = code == DDS_RETCODE_TIMEOUT ? StatusCode::timed_out : StatusCode::io;
  return {kind, fmt::format("could not {}: {}", what, dds_strretcode(-code))};
}

}  // namespace bleedsim::transport
