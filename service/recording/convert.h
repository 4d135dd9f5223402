// Samples of idl/bleed.idl (C structs) <-> messages of idl/recording.proto. Both ways keep every bit of every member, apart from
// the unused octet of `Empty`.
#pragma once

#include <memory>

#include "idl/bleed.h"
#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// `out` is overwritten. invalid_argument: a sequence has a length but no data, or a text is not UTF-8; the message names the
/// member. unsupported: a union case that this version does not know.
::bleedsim::Status toRecording(const bleed_v1_Frame& sample, Frame& out);
::bleedsim::Status toRecording(const bleed_v1_FrameStats& sample, FrameStats& out);
::bleedsim::Status toRecording(const bleed_v1_Status& sample, recording::Status& out);
::bleedsim::Status toRecording(const bleed_v1_Scene& sample, Scene& out);
::bleedsim::Status toRecording(const bleed_v1_Journal& sample, Journal& out);

/// Frees a sample and all that it owns.
struct SampleDelete {
  void operator()(bleed_v1_Frame* sample) const;
  void operator()(bleed_v1_FrameStats* sample) const;
  void operator()(bleed_v1_Status* sample) const;
  void operator()(bleed_v1_Scene* sample) const;
  void operator()(bleed_v1_Journal* sample) const;
};
template <class T>
using SamplePtr = std::unique_ptr<T, SampleDelete>;

/// data_loss: a message that no sample can have given (an identity that is not 16 bytes, a text or list beyond its bound, a
/// journal entry without body); the message names the member.
Result<SamplePtr<bleed_v1_Frame>> fromRecording(const Frame& message);
Result<SamplePtr<bleed_v1_FrameStats>> fromRecording(const FrameStats& message);
Result<SamplePtr<bleed_v1_Status>> fromRecording(const recording::Status& message);
Result<SamplePtr<bleed_v1_Scene>> fromRecording(const Scene& message);
Result<SamplePtr<bleed_v1_Journal>> fromRecording(const Journal& message);

}  // namespace bleedsim::recording
