// The body of a request on the daemon's side.
#include <string>

#include "service/dds/decode.h"
#include "service/dds/request.h"
#include "tests/fuzz/request_bytes.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bleedsim;
  fuzz::FuzzInput input{data, size};
  bleed_v1_Request request{};
  fuzz::RequestBytes bytes;
  bytes.fill(input, request.body);
  const Result<dds::Action> action = dds::decodeAction(request.body);
  const Result<std::string> name = dds::decodeWoundName(request.body);
  if (!action || !name) {
    const Status& why = action ? name.status() : action.status();
    fuzz::require(why.code() == StatusCode::invalid_argument || why.code() == StatusCode::unsupported, "a refusal has its code");
    fuzz::require(!why.message().empty(), "a refusal has a reason");
    return 0;
  }
  const dds::RequestCopy copy{request};
  fuzz::require(copy.sample().body._d == request.body._d, "a copy is of the same kind");
  return 0;
}
