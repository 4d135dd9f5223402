// Which description a saved state belongs to.
#pragma once

#include <cstdint>

#include "service/sph/world_description.h"

namespace bleedsim::sph {

/// Of every field that a world is made from. Equal descriptions have equal hashes, on any machine.
std::uint64_t descriptionHash(const WorldDescription& description);

}  // namespace bleedsim::sph
