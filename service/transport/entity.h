// A DDS entity handle that deletes its entity.
#pragma once

#include <dds/dds.h>
#include <string_view>
#include <utility>

#include "service/status/status.h"

namespace bleedsim::transport {

class Entity {
 public:
  Entity() = default;
  explicit Entity(dds_entity_t handle) : handle_{handle} {}
  Entity(Entity&& other) noexcept : handle_{std::exchange(other.handle_, 0)} {}
  Entity& operator=(Entity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }
  Entity(const Entity&) = delete;
  Entity& operator=(const Entity&) = delete;
  ~Entity() { reset(); }

  /// Takes the answer of a dds_create_... call; a negative one becomes an io status "could not <what>: <DDS's text>".
  static Result<Entity> adopt(dds_entity_t handle, std::string_view what);

  dds_entity_t get() const { return handle_; }
  explicit operator bool() const { return handle_ > 0; }

 private:
  void reset() {
    if (handle_ > 0) dds_delete(handle_);
    handle_ = 0;
  }

  dds_entity_t handle_ = 0;
};

/// ok for a code >= 0; otherwise timed_out or io with "could not <what>: <DDS's text>".
Status ddsStatus(dds_return_t code, std::string_view what);

}  // namespace bleedsim::transport
