#include "service/dds/bounded_text.h"
#include "service/dds/decode.h"
#include "service/dds/value_check.h"

namespace bleedsim::dds {

Result<InstrumentSample> decodeInstrument(const bleed_v1_Instrument& sample) {
  const Result<sph::Vec3> position = checkVector("instrument.position", sample.position, kCoordinate);
  if (!position) return position.status();
  const Result<sph::Vec3> force = checkLength("instrument.force", sample.force, kForce);
  if (!force) return force.status();
  if (Status radius = checkNumber("instrument.tip_radius_m", sample.tip_radius_m, kForceRadius); !radius) return radius;
  // The orientation is recorded but not used yet, so it only has to be a number.
  const double orientation[] = {sample.orientation.x, sample.orientation.y, sample.orientation.z, sample.orientation.w};
  for (const double component : orientation) {
    if (Status checked = checkNumber("instrument.orientation", component, kComponent); !checked) return checked;
  }
  if (Status name = checkLabel("instrument.name", viewText(sample.name)); !name) return name;
  InstrumentSample out;
  out.key = {transport::toUuid(sample.client), sample.tool};
  out.seq = sample.seq;
  out.client_stamp_ns = sample.stamp_ns;
  out.position = *position;
  out.radius = sample.tip_radius_m;
  out.force = *force;
  out.original = sample;
  return out;
}

}  // namespace bleedsim::dds
