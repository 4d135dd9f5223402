#include "service/lab/markdown_block.h"

#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <sstream>

namespace bleedsim::lab {
namespace {

Result<std::string> textOf(const std::string& file) {
  std::error_code error;
  std::ifstream stream{file, std::ios::binary};
  std::ostringstream text;
  text << stream.rdbuf();
  if (!std::filesystem::is_regular_file(file, error) || !stream)
    return Status{StatusCode::not_found, fmt::format("cannot read '{}'; give a Markdown file", file)};
  return text.str();
}

/// Of the text's line `line`; npos if it does not stand there exactly once.
std::size_t onlyLine(const std::string& text, const std::string& line) {
  const std::string after = "\n" + text;  // so that the first line has a break before it, too
  const std::size_t found = after.find("\n" + line + "\n");
  if (found == std::string::npos || after.find("\n" + line + "\n", found + 1) != std::string::npos) return std::string::npos;
  return found;
}

}  // namespace

Result<std::string> withBlock(const std::string& text, const std::string& name, const std::string& content) {
  const std::string begin = fmt::format("<!-- begin {} -->", name);
  const std::string end = fmt::format("<!-- end {} -->", name);
  const std::size_t from = onlyLine(text, begin);
  const std::size_t to = onlyLine(text, end);
  if (from == std::string::npos || to == std::string::npos || to < from)
    return Status{StatusCode::invalid_argument, fmt::format("needs one line '{}' and, after it, one line '{}'", begin, end)};
  return text.substr(0, from + begin.size() + 1) + content + text.substr(to);
}

Status checkBlock(const std::string& file, const std::string& name) {
  const auto text = textOf(file);
  if (!text) return text.status();
  const auto replaced = withBlock(*text, name, "");
  if (!replaced) return {replaced.status().code(), fmt::format("'{}' {}", file, replaced.status().message())};
  return {};
}

Status replaceBlock(const std::string& file, const std::string& name, const std::string& content) {
  const auto text = textOf(file);
  if (!text) return text.status();
  const auto replaced = withBlock(*text, name, content);
  if (!replaced) return {replaced.status().code(), fmt::format("'{}' {}", file, replaced.status().message())};
  const std::string beside = file + ".new";
  std::ofstream out{beside, std::ios::binary | std::ios::trunc};
  out << *replaced;
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(beside, file, error);
  if (out && !error) return {};
  std::filesystem::remove(beside, error);
  return {StatusCode::io, fmt::format("cannot write '{}'; check the folder and the disk", file)};
}

}  // namespace bleedsim::lab
