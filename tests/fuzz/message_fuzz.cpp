// The messages of a recording behind its checksums: of any bytes, and back into a sample and a message again.
#include <string>

#include "idl/recording.pb.h"
#include "service/recording/convert.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace bleedsim;

template <class Message>
void roundTrip(std::span<const std::uint8_t> bytes) {
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return;
  const auto sample = recording::fromRecording(message);
  if (!sample) {
    fuzz::require(sample.status().code() == StatusCode::data_loss, "a message of no sample is a loss of data");
    return;
  }
  Message again;
  if (!recording::toRecording(**sample, again)) return;  // a text of the file that is not UTF-8
  const auto same = recording::fromRecording(again);
  fuzz::require(same.ok(), "what a sample gives can be read back");
  Message once_more;
  fuzz::require(recording::toRecording(**same, once_more).ok(), "what was read back can be written");
  fuzz::require(once_more.SerializeAsString() == again.SerializeAsString(), "both ways keep every bit");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::FuzzInput input{data, size};
  switch (input.take<std::uint8_t>() % 5U) {
    case 0:
      roundTrip<recording::Frame>(input.rest());
      break;
    case 1:
      roundTrip<recording::FrameStats>(input.rest());
      break;
    case 2:
      roundTrip<recording::Status>(input.rest());
      break;
    case 3:
      roundTrip<recording::Scene>(input.rest());
      break;
    default:
      roundTrip<recording::Journal>(input.rest());
      break;
  }
  return 0;
}
