// The body of a request as the middleware may give it: any numbers, unterminated texts, booleans of any byte; sequences and texts
// lie in memory of exactly their length.
#include <string>
#include <vector>

#include "service/dds/decode.h"
#include "service/dds/request.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace bleedsim;
using fuzz::FuzzInput;

constexpr std::size_t kMostOutlineNumbers = 512;  // the bound of the contract

/// A wound with an outline that it owns.
struct WoundBytes {
  std::vector<double> outline;

  void fill(FuzzInput& input, bleed_v1_Wound& wound) {
    input.takeInto(wound);
    outline = input.takeList<double>(input.take<std::uint16_t>() % (kMostOutlineNumbers + 1));
    const auto count = static_cast<std::uint32_t>(outline.size());
    wound.outline = {count, count, outline.empty() ? nullptr : outline.data(), false};
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzInput input{data, size};
  bleed_v1_Request request{};
  bleed_v1_RequestBody& body = request.body;
  const auto kind = input.take<std::uint8_t>();
  body._d = kind < 255 ? kind % 20U : input.take<std::uint32_t>();
  WoundBytes wound;
  std::vector<char> text;
  if (body._d == bleed_v1_REQUEST_WOUND_ADD) {
    wound.fill(input, body._u.wound_add);
  } else if (body._d == bleed_v1_REQUEST_WOUND_UPDATE) {
    input.takeInto(body._u.wound_update);
    wound.fill(input, body._u.wound_update.wound);
  } else if (body._d == bleed_v1_REQUEST_LOAD_SCENE) {
    text.assign(input.rest().begin(), input.rest().end());
    text.push_back('\0');
    body._u.load_scene.text = text.size() == 1 ? nullptr : text.data();
  } else {
    input.takeInto(body._u);
  }
  const Result<dds::Action> action = dds::decodeAction(body);
  const Result<std::string> name = dds::decodeWoundName(body);
  if (!action || !name) {
    const Status& why = action ? name.status() : action.status();
    fuzz::require(why.code() == StatusCode::invalid_argument || why.code() == StatusCode::unsupported, "a refusal has its code");
    fuzz::require(!why.message().empty(), "a refusal has a reason");
    return 0;
  }
  const dds::RequestCopy copy{request};
  fuzz::require(copy.sample().body._d == body._d, "a copy is of the same kind");
  return 0;
}
