// A frame as a .vtp file: VTK XML poly data, raw appended, little-endian.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <string>

#include "idl/recording.pb.h"
#include "service/status/status.h"

namespace bleedsim::recording {

/// The text and bytes of one file. data_loss: as layoutOf().
Result<std::string> toVtp(const Frame& frame);

}  // namespace bleedsim::recording
