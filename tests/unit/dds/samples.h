// Valid samples that a test spoils in one place.
#pragma once

#include "idl/bleed.h"
#include "service/dds/bounded_text.h"

namespace bleedsim::dds {

inline bleed_v1_Wound discWound() {
  bleed_v1_Wound wound{};
  copyText("cut", wound.name);
  wound.position = {0.01, 0.02, 0.0};
  wound.normal = {0.0, 0.0, 2.0};
  wound.shape = bleed_v1_SHAPE_DISC;
  wound.radius_m = 0.003;
  wound.drive = bleed_v1_DRIVE_FLOW;
  wound.flow_ml_per_s = 2.0;
  return wound;
}

inline bleed_v1_Force push() { return {{0.0, 0.0, 0.01}, 0.005, {0.0, 0.0, -0.1}, 0.2}; }

inline bleed_v1_Instrument instrumentSample() {
  bleed_v1_Instrument sample{};
  sample.client[0] = 7;
  sample.tool = 3;
  sample.seq = 41;
  sample.stamp_ns = 1234;
  copyText("PSM1", sample.name);
  sample.position = {0.0, 0.0, 0.01};
  sample.orientation = {0.0, 0.0, 0.0, 1.0};
  sample.tip_radius_m = 0.005;
  sample.force = {0.1, 0.0, 0.0};
  return sample;
}

}  // namespace bleedsim::dds
