// A child process whose end and output a test can wait for.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace bleedsim::service_test {

/// Far more than anything takes, so that a busy machine fails no test.
inline constexpr std::chrono::seconds kPatience{60};

/// Killed at the end of its life if it still runs.
class Child {
 public:
  explicit Child(const std::vector<std::string>& command);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal) const;
  /// Waits for the end: exit code, -signal if one killed it, nothing if it still runs after the patience.
  std::optional<int> wait(std::chrono::milliseconds patience = kPatience);
  /// Waits until the output, standard and error, holds this text.
  bool waitForOutput(const std::string& text);
  /// All output until the end of the process.
  std::string output();
  /// Readable once the process has ended.
  int endDescriptor() const { return end_; }

 private:
  bool readMore(std::chrono::milliseconds patience);

  pid_t pid_ = -1;
  int end_ = -1;
  int pipe_ = -1;
  std::string output_;
  std::optional<int> code_;
};

}  // namespace bleedsim::service_test
