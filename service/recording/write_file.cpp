#include "service/recording/write_file.h"

#include <fmt/core.h>
#include <system_error>

#include "service/recording/file_sink.h"

namespace bleedsim::recording {

::bleedsim::Status createFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error) && !error) error = std::make_error_code(std::errc::not_a_directory);
  if (!error) return {};
  return {StatusCode::io,
          fmt::format("cannot create directory '{}': {}; choose one that you may write", folder.string(), error.message())};
}

::bleedsim::Status writeFile(const std::filesystem::path& path, std::string_view content) {
  Result<FileSink> sink = FileSink::open(path);
  if (!sink) return sink.status();
  const ::bleedsim::Status written = sink->write(content);
  const ::bleedsim::Status closed = sink->closeQuickly();
  return written ? closed : written;
}

}  // namespace bleedsim::recording
