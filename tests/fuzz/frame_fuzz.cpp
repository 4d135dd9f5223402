// A frame on the client's side: attributes and payload of any lengths, in memory of exactly their size.
#include <algorithm>
#include <cmath>
#include <vector>

#include "clients/lib/frame_decoder.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

constexpr std::size_t kMostAttributes = 16;  // the bound of the contract

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bleedsim;
  fuzz::FuzzInput input{data, size};
  bleed_v1_Frame wire{};
  wire.count = input.take<std::uint32_t>();
  wire.sim_time_s = input.take<double>();
  std::vector<bleed_v1_Attribute> attributes =
      input.takeList<bleed_v1_Attribute>(input.take<std::uint8_t>() % (kMostAttributes + 1));
  std::vector<std::uint8_t> payload = input.takeList<std::uint8_t>(input.rest().size());
  const auto blocks = static_cast<std::uint32_t>(attributes.size());
  const auto bytes = static_cast<std::uint32_t>(payload.size());
  wire.attributes = {blocks, blocks, attributes.empty() ? nullptr : attributes.data(), false};
  wire.payload = {bytes, bytes, payload.empty() ? nullptr : payload.data(), false};

  static client::Frame frame;  // frames are reused
  const Status decoded = client::FrameDecoder::decode(wire, frame);
  if (!decoded) {
    fuzz::require(decoded.code() == StatusCode::data_loss, "a bad frame is a loss of data");
    return 0;
  }
  const std::size_t count = frame.count();
  fuzz::require(frame.positions().size() == 3 * count && frame.ids().size() == count, "positions and ids are of all particles");
  fuzz::require(frame.velocities().empty() || frame.velocities().size() == 3 * count,
                "velocities are of all particles or absent");
  for (const auto& optional : {frame.radii(), frame.platelets(), frame.viscosities(), frame.densities()}) {
    fuzz::require(optional.empty() || optional.size() == count, "an attribute is of all particles or absent");
  }
  const auto positions = frame.positions();
  fuzz::require(std::all_of(positions.begin(), positions.end(), [](float value) { return std::isfinite(value); }),
                "positions are finite");
  return 0;
}
