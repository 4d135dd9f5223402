// Protobuf texts are UTF-8: a message with other bytes in a text could be written but not read back.
#pragma once

#include <string_view>

namespace bleedsim::recording {

/// RFC 3629: shortest forms only, no surrogates, up to U+10FFFF.
bool isUtf8(std::string_view text);

}  // namespace bleedsim::recording
