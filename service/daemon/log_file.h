// A log file that a rotating tool may move away.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <spdlog/sinks/base_sink.h>
#include <string>

#include "service/status/status.h"

namespace bleedsim::daemon {

/// Appends each line by one write, so that other writers do not split it. Lines that the system does not take, as on a full disk,
/// are counted, and the next one that it takes says how many there were.
class LogFile final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  /// io: it cannot be opened for appending; the message says why.
  static Result<std::shared_ptr<LogFile>> open(const std::string& path);
  ~LogFile() override;

  /// Closes the file and opens the path anew, for what was moved away stays open under its new name. On failure the old one goes
  /// on.
  Status reopen();

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override {}

 private:
  LogFile(std::string path, int file) : path_{std::move(path)}, file_{file} {}

  const std::string path_;
  int file_;
  std::uint64_t lost_ = 0;  // lines since the last one that was written
  bool cut_ = false;        // of one of these, the beginning was
};

}  // namespace bleedsim::daemon
