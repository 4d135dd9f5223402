// Commands of the library -> requests of the wire. Values are the service's to judge; what does not fit the wire is refused here.
#pragma once

#include "bleedsim/commands.h"
#include "clients/lib/request_tracker.h"

namespace bleedsim::client {

Result<RequestPointer> buildAddWound(const WoundSpec& wound);
Result<RequestPointer> buildUpdateWound(std::uint32_t wound_id, const WoundChange& change);
RequestPointer buildRemoveWound(std::uint32_t wound_id);
/// By the name it was opened with.
Result<RequestPointer> buildUpdateWound(const std::string& name, const WoundChange& change);
Result<RequestPointer> buildRemoveWound(const std::string& name);
RequestPointer buildForce(const ForceSpec& force);
RequestPointer buildStep(std::uint32_t count);
RequestPointer buildPace(const Pace& pace);
Result<RequestPointer> buildOutput(const OutputSpec& output);
Result<RequestPointer> buildLoadScene(const std::string& text);
Result<RequestPointer> buildEffect(const std::string& name, bool enabled, const std::string& settings);
RequestPointer buildPing(std::int64_t stamp_ns);
RequestPointer buildAcquire(double seconds);
Result<RequestPointer> buildCheckpoint(const std::string& name);
Result<RequestPointer> buildRestore(const std::string& name);
/// REQUEST_PAUSE, _RESUME, _RESET, _SHUTDOWN or _RELEASE.
RequestPointer buildPlain(std::uint32_t request);

}  // namespace bleedsim::client
