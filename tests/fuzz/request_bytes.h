// The body of a request as the middleware may give it: any numbers, unterminated texts, booleans of any byte; sequences and texts
// lie in memory of exactly their length.
#pragma once

#include <vector>

#include "idl/bleed.h"
#include "tests/fuzz/fuzz_input.h"

namespace bleedsim::fuzz {

/// Owns what the body that it has filled points to.
class RequestBytes {
 public:
  /// The first byte says which kind; the text of a scene is all that follows.
  void fill(FuzzInput& input, bleed_v1_RequestBody& body) {
    const auto kind = input.take<std::uint8_t>();
    body._d = kind < 255 ? kind % 20U : input.take<std::uint32_t>();
    if (body._d == bleed_v1_REQUEST_WOUND_ADD) {
      fillWound(input, body._u.wound_add);
    } else if (body._d == bleed_v1_REQUEST_WOUND_UPDATE) {
      input.takeInto(body._u.wound_update);
      fillWound(input, body._u.wound_update.wound);
    } else if (body._d == bleed_v1_REQUEST_LOAD_SCENE) {
      text_.assign(input.rest().begin(), input.rest().end());
      text_.push_back('\0');
      body._u.load_scene.text = text_.size() == 1 ? nullptr : text_.data();
    } else {
      input.takeInto(body._u);
    }
  }

 private:
  void fillWound(FuzzInput& input, bleed_v1_Wound& wound) {
    constexpr std::size_t kMostOutlineNumbers = 512;  // the bound of the contract
    input.takeInto(wound);
    outline_ = input.takeList<double>(input.take<std::uint16_t>() % (kMostOutlineNumbers + 1));
    const auto count = static_cast<std::uint32_t>(outline_.size());
    wound.outline = {count, count, outline_.empty() ? nullptr : outline_.data(), false};
  }

  std::vector<double> outline_;
  std::vector<char> text_;
};

}  // namespace bleedsim::fuzz
