// How a request ended.
#pragma once

#include <cstdint>
#include <string>

#include "idl/bleed.h"
#include "service/dds/identity.h"
#include "service/status/status.h"

namespace bleedsim::dds {

enum class ReplyCode : std::uint32_t {
  accepted = bleed_v1_REPLY_ACCEPTED,
  invalid = bleed_v1_REPLY_INVALID,
  not_found = bleed_v1_REPLY_NOT_FOUND,
  capacity = bleed_v1_REPLY_CAPACITY,
  unsupported = bleed_v1_REPLY_UNSUPPORTED,
  state = bleed_v1_REPLY_STATE,
  scene = bleed_v1_REPLY_SCENE,
  busy = bleed_v1_REPLY_BUSY,
  stale = bleed_v1_REPLY_STALE,
  failed = bleed_v1_REPLY_FAILED,
  leased = bleed_v1_REPLY_LEASED,
};

/// The code that answers a refusal of that kind.
constexpr ReplyCode replyCode(StatusCode code) {
  switch (code) {
    case StatusCode::ok:
      return ReplyCode::accepted;
    case StatusCode::invalid_argument:
      return ReplyCode::invalid;
    case StatusCode::not_found:
      return ReplyCode::not_found;
    case StatusCode::capacity:
      return ReplyCode::capacity;
    case StatusCode::wrong_state:
      return ReplyCode::state;
    case StatusCode::unsupported:
      return ReplyCode::unsupported;
    case StatusCode::unavailable:
      return ReplyCode::leased;
    case StatusCode::timed_out:
    case StatusCode::io:
    case StatusCode::data_loss:
    case StatusCode::internal:
      break;
  }
  return ReplyCode::failed;
}

struct Reply {
  RequestKey key;
  ReplyCode code = ReplyCode::accepted;
  std::uint64_t applied_step = 0;  ///< the first step that used the request, or the coming one; 0: a new world
  double sim_time = 0.0;           ///< s
  std::uint32_t epoch = 0;
  std::uint32_t object_id = 0;  ///< of the wound added or touched, 0: none
  std::string reason;           ///< for a person; at most 127 bytes on the wire, whole words and "..." of a longer one
  std::int64_t client_stamp_ns = 0;
  std::int64_t receive_stamp_ns = 0;
  std::int64_t reply_stamp_ns = 0;  ///< of the first time it was sent
  std::string object_name{};        ///< of the checkpoint written or restored
};

}  // namespace bleedsim::dds
