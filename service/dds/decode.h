// Samples from outside become checked values of the service. Nothing is trusted: lengths, pointers, numbers, enumerations and
// union cases are checked here, and a refusal names the field, the value and what is allowed.
#pragma once

#include "idl/bleed.h"
#include "service/dds/request.h"
#include "service/status/status.h"

namespace bleedsim::dds {

/// invalid_argument for a bad value, unsupported for a request or output attribute that this version does not know.
Result<Action> decodeAction(const bleed_v1_RequestBody& body);

/// The name by which a request tells its wound; empty: by the id, or it has none. invalid_argument: by both.
Result<std::string> decodeWoundName(const bleed_v1_RequestBody& body);

RequestKey requestKey(const bleed_v1_Request& sample);

/// invalid_argument for a bad value.
Result<sph::WoundDescription> decodeWound(const bleed_v1_Wound& sample);

/// Only the members that `fields` names are read and checked.
Result<sph::UpdateWound> decodeWoundUpdate(const bleed_v1_WoundUpdate& sample);

/// invalid_argument for a bad value.
Result<InstrumentSample> decodeInstrument(const bleed_v1_Instrument& sample);

}  // namespace bleedsim::dds
