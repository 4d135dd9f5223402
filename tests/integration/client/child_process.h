// A program of ours in a process of its own, with its output.
#pragma once

#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace bleedsim::client_test {

class ChildProcess {
 public:
  /// The program's path and arguments; stdout is caught, stderr too when `with_stderr`.
  explicit ChildProcess(const std::vector<std::string>& command, bool with_stderr = false);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills it if it still runs.
  ~ChildProcess();

  void signal(int number) const;
  /// Reads up to and with the next newline; nothing at the end of the output.
  std::optional<std::string> readLine();
  /// Reads the rest and waits for the end: the exit code, or 128 and the signal's number.
  int wait();
  const std::string& output() const { return output_; }

 private:
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::string output_;
  std::size_t read_ = 0;  // bytes of output_ given out as lines
};

struct Finished {
  int code = -1;
  std::string output;
};

/// Runs to the end.
Finished runProcess(const std::vector<std::string>& command, bool with_stderr = false);

}  // namespace bleedsim::client_test
