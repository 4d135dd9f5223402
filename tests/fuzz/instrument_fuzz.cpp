// An instrument sample of any bytes: refused, or with finite values.
#include <cmath>

#include "service/dds/decode.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bleedsim;
  bleed_v1_Instrument sample{};
  fuzz::FuzzInput{data, size}.takeInto(sample);
  const Result<dds::InstrumentSample> decoded = dds::decodeInstrument(sample);
  if (!decoded) {
    fuzz::require(decoded.status().code() == StatusCode::invalid_argument, "a bad sample is an invalid argument");
    return 0;
  }
  fuzz::require(decoded->position.allFinite() && decoded->force.allFinite(), "what is accepted is finite");
  fuzz::require(decoded->radius > 0.0 && std::isfinite(decoded->radius), "what is accepted has a radius");
  return 0;
}
