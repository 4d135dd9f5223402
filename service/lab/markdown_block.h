// A part of a Markdown file that a command writes: what stands between the lines <!-- begin NAME --> and <!-- end NAME -->.
#pragma once

#include <string>

#include "service/status/status.h"

namespace bleedsim::lab {

/// The text with the block's content replaced. invalid_argument without exactly one line of each kind in their order.
Result<std::string> withBlock(const std::string& text, const std::string& name, const std::string& content);

/// The same with a file, which is replaced whole or not at all.
Status replaceBlock(const std::string& file, const std::string& name, const std::string& content);
/// Whether replaceBlock() would find its place.
Status checkBlock(const std::string& file, const std::string& name);

}  // namespace bleedsim::lab
