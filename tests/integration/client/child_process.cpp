#include "tests/integration/client/child_process.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bleedsim::client_test {

ChildProcess::ChildProcess(const std::vector<std::string>& command, bool with_stderr) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (with_stderr) posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  if (posix_spawnp(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ) != 0) pid_ = -1;
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  pipe_ = ends[0];
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    wait();
  }
  if (pipe_ >= 0) close(pipe_);
}

void ChildProcess::signal(int number) const {
  if (pid_ > 0) kill(pid_, number);
}

std::optional<std::string> ChildProcess::readLine() {
  std::array<char, 4096> buffer;
  for (;;) {
    const std::size_t end = output_.find('\n', read_);
    if (end != std::string::npos) {
      const std::string line = output_.substr(read_, end + 1 - read_);
      read_ = end + 1;
      return line;
    }
    const ssize_t got = read(pipe_, buffer.data(), buffer.size());
    if (got <= 0) return std::nullopt;
    output_.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

int ChildProcess::wait() {
  if (pid_ <= 0) return -1;
  while (readLine()) {}
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Finished runProcess(const std::vector<std::string>& command, bool with_stderr) {
  ChildProcess child{command, with_stderr};
  const int code = child.wait();
  return {code, child.output()};
}

}  // namespace bleedsim::client_test
