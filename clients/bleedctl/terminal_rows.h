// Rows on a terminal that are written over again and again. A row that is wider than the terminal would wrap, and what comes next
// would not stand over it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bleedsim::bleedctl {

/// As much of UTF-8 text as `columns` bytes hold, whole characters.
std::string_view cutToColumns(std::string_view row, std::size_t columns);

/// What to print so that `rows` stand where the last `shown` rows stood, the cursor behind the last of them.
std::string overwriteRows(std::size_t shown, const std::vector<std::string>& rows, std::size_t columns);

/// Of the terminal at stdout; 80 where it does not say.
std::size_t terminalColumns();

}  // namespace bleedsim::bleedctl
