// Checks of single values: each names the field, the value and what is allowed.
#pragma once

#include <string_view>

#include "idl/bleed.h"
#include "service/dds/command_limits.h"
#include "service/sph/world_description.h"
#include "service/status/status.h"

namespace bleedsim::dds {

/// ok if `value` is finite and within `range`, both ends included.
Status checkNumber(std::string_view field, double value, const Range& range);

/// All three components by checkNumber().
Result<sph::Vec3> checkVector(std::string_view field, const bleed_v1_Vec3& value, const Range& range);

/// A vector whose length is within `range`.
Result<sph::Vec3> checkLength(std::string_view field, const bleed_v1_Vec3& value, const Range& range);

/// A vector whose length can be divided by, made of length one.
Result<sph::Vec3> checkDirection(std::string_view field, const bleed_v1_Vec3& value);

/// ok if the text is printable: UTF-8 without control characters.
Status checkLabel(std::string_view field, std::string_view text);

}  // namespace bleedsim::dds
