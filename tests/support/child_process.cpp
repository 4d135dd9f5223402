#include "tests/support/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bleedsim::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// True once one of them is readable or at its end; descriptors of -1 are left out.
bool waitReadable(pollfd* descriptors, nfds_t count, milliseconds patience) {
  int ready = 0;
  do { ready = poll(descriptors, count, static_cast<int>(patience.count())); } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, bool with_stderr) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error{"no pipe for " + command[0]};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (with_stderr) posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int failed = posix_spawnp(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  pipe_ = ends[0];
  if (failed == 0) end_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  if (end_ >= 0) return;
  close(pipe_);
  throw std::runtime_error{"could not start " + command[0]};
}

ChildProcess::~ChildProcess() {
  if (!code_) {
    signal(SIGKILL);
    wait();
  }
  if (pipe_ >= 0) close(pipe_);
  close(end_);
}

void ChildProcess::signal(int number) const {
  if (!code_) kill(pid_, number);
}

std::optional<int> ChildProcess::wait(milliseconds patience) {
  if (code_) return code_;
  const auto give_up = steady_clock::now() + patience;
  for (;;) {
    std::array<pollfd, 2> waited{{{end_, POLLIN, 0}, {pipe_, POLLIN, 0}}};
    const auto left = std::chrono::ceil<milliseconds>(give_up - steady_clock::now());
    if (!waitReadable(waited.data(), waited.size(), std::max(left, milliseconds{0}))) return {};
    if (waited[1].revents != 0) {
      readMore({});
    } else if (waited[0].revents != 0) {
      break;
    }
  }
  int status = 0;
  if (waitpid(pid_, &status, 0) != pid_) return {};
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return code_;
}

bool ChildProcess::readMore(milliseconds patience) {
  pollfd waited{pipe_, POLLIN, 0};
  if (pipe_ < 0 || !waitReadable(&waited, 1, patience)) return false;
  std::array<char, 4096> buffer;
  const ssize_t count = read(pipe_, buffer.data(), buffer.size());
  if (count > 0) {
    output_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }
  close(pipe_);
  pipe_ = -1;
  return false;
}

std::optional<std::string> ChildProcess::readLine() {
  std::size_t end = output_.find('\n', read_);
  while (end == std::string::npos) {
    if (!readMore(kPatience)) return {};
    end = output_.find('\n', read_);
  }
  const std::string line = output_.substr(read_, end + 1 - read_);
  read_ = end + 1;
  return line;
}

bool ChildProcess::waitForOutput(const std::string& text) {
  while (output_.find(text) == std::string::npos) {
    if (!readMore(kPatience)) return false;
  }
  return true;
}

Finished runProcess(const std::vector<std::string>& command, bool with_stderr, milliseconds patience) {
  ChildProcess child{command, with_stderr};
  const int code = child.wait(patience).value_or(-1);
  return {code, child.output()};
}

}  // namespace bleedsim::test
