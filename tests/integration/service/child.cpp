#include "tests/integration/service/child.h"

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

namespace bleedsim::service_test {
namespace {

bool waitReadable(int descriptor, std::chrono::milliseconds patience) {
  pollfd waited{descriptor, POLLIN, 0};
  int ready = 0;
  do { ready = poll(&waited, 1, static_cast<int>(patience.count())); } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

}  // namespace

Child::Child(const std::vector<std::string>& command) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error{"pipe"};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const int failed = posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  pipe_ = ends[0];
  if (failed != 0) throw std::runtime_error{"could not start " + command[0]};
  end_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
}

Child::~Child() {
  if (!code_) {
    send(SIGKILL);
    wait();
  }
  close(pipe_);
  close(end_);
}

void Child::send(int signal) const { kill(pid_, signal); }

std::optional<int> Child::wait(std::chrono::milliseconds patience) {
  if (code_) return code_;
  if (!waitReadable(end_, patience)) return {};
  int status = 0;
  if (waitpid(pid_, &status, 0) != pid_) return {};
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return code_;
}

bool Child::readMore(std::chrono::milliseconds patience) {
  std::array<char, 4096> buffer{};
  if (!waitReadable(pipe_, patience)) return false;
  const ssize_t count = read(pipe_, buffer.data(), buffer.size());
  if (count <= 0) return false;
  output_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

bool Child::waitForOutput(const std::string& text) {
  while (output_.find(text) == std::string::npos) {
    if (!readMore(kPatience)) return false;
  }
  return true;
}

std::string Child::output() {
  while (readMore(kPatience)) {}
  return output_;
}

}  // namespace bleedsim::service_test
