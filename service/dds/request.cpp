#include "service/dds/request.h"

namespace bleedsim::dds {

RequestCopy::RequestCopy(const bleed_v1_Request& sample) : sample_{sample} {
  const auto own_outline = [this](bleed_v1_Wound& wound) {
    if (wound.outline._length > 0) outline_.assign(wound.outline._buffer, wound.outline._buffer + wound.outline._length);
    const auto length = static_cast<std::uint32_t>(outline_.size());
    wound.outline = {length, length, outline_.empty() ? nullptr : outline_.data(), false};
  };
  switch (sample_.body._d) {
    case bleed_v1_REQUEST_WOUND_ADD:
      own_outline(sample_.body._u.wound_add);
      break;
    case bleed_v1_REQUEST_WOUND_UPDATE:
      own_outline(sample_.body._u.wound_update.wound);
      break;
    case bleed_v1_REQUEST_LOAD_SCENE:
      sample_.body._u.load_scene.text = no_text_;
      break;
    default:
      break;
  }
}

}  // namespace bleedsim::dds
