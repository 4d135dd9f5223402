#include "clients/bleedctl/terminal_rows.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace bleedsim::bleedctl {

std::string_view cutToColumns(std::string_view row, std::size_t columns) {
  if (row.size() <= columns) return row;
  while (columns > 0 && (static_cast<unsigned char>(row[columns]) & 0xC0U) == 0x80U) --columns;
  return row.substr(0, columns);
}

std::string overwriteRows(std::size_t shown, const std::vector<std::string>& rows, std::size_t columns) {
  std::string text = shown > 1 ? fmt::format("\r\x1b[{}A", shown - 1) : "\r";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    text += fmt::format("{}{}\x1b[K", k == 0 ? "" : "\r\n", cutToColumns(rows[k], columns));
  }
  return text + "\x1b[J";  // rows below, of a taller one before
}

std::size_t terminalColumns() {
  winsize size{};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace bleedsim::bleedctl
