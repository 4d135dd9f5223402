// A program in a process of its own, whose end and output a test can wait for.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace bleedsim::test {

/// Far more than anything takes, so that a busy machine fails no test.
inline constexpr std::chrono::seconds kPatience{60};

/// Killed at the end of its life if it still runs.
class ChildProcess {
 public:
  /// The program's path and arguments; stdout is caught, stderr too when `with_stderr`. Throws if it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command, bool with_stderr = true);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number) const;

  /// Waits for the end: the exit code, or 128 and the signal's number; nothing if it still runs after the patience. Takes the
  /// output meanwhile, so that a full pipe holds nobody up.
  std::optional<int> wait(std::chrono::milliseconds patience = kPatience);
  /// Waits for the next newline and gives the line with it; nothing at the end of the output or after kPatience without any.
  std::optional<std::string> readLine();
  /// Waits until the output holds this text; false when it ends, or pauses for kPatience, without.
  bool waitForOutput(const std::string& text);
  /// What was read so far: everything once wait() has told the end.
  const std::string& output() const { return output_; }
  /// Readable once the process has ended.
  int endDescriptor() const { return end_; }

 private:
  bool readMore(std::chrono::milliseconds patience);

  pid_t pid_ = -1;
  int end_ = -1;
  int pipe_ = -1;  // -1 at the end of the output
  std::string output_;
  std::size_t read_ = 0;  // bytes of output_ given out as lines
  std::optional<int> code_;
};

struct Finished {
  int code = -1;
  std::string output;
};

/// Runs to the end; code -1 if it does not end within the patience.
Finished runProcess(const std::vector<std::string>& command, bool with_stderr = true,
                    std::chrono::milliseconds patience = std::chrono::minutes{5});

}  // namespace bleedsim::test
