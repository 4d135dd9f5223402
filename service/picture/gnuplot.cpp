#include "service/picture/gnuplot.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace bleedsim::picture {
namespace {

constexpr std::size_t kMostSaid = 600;  // bytes of a failed child's words in a message

using Clock = std::chrono::steady_clock;

std::string reasonOf(int error) { return std::generic_category().message(error); }

/// The reading end of what the child says.
class Pipe {
 public:
  Pipe() = default;
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    closeWriting();
    if (ends_[0] >= 0) ::close(ends_[0]);
  }

  bool open() { return ::pipe2(ends_.data(), O_CLOEXEC) == 0; }
  void closeWriting() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// Reads until the child closes its end; false when the deadline comes first.
bool readAll(int descriptor, Clock::time_point deadline, std::string& said) {
  std::array<char, 4096> buffer{};
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd wait{descriptor, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(left));
    if (ready < 0 && errno != EINTR) return true;
    if (ready <= 0) continue;
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    if (said.size() < kMostSaid) said.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

int waitFor(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}

/// One line, without blanks around.
std::string shown(std::string said) {
  if (said.size() > kMostSaid) said.resize(kMostSaid);
  for (char& c : said) {
    if (static_cast<unsigned char>(c) < 0x20U) c = ' ';
  }
  const std::size_t first = said.find_first_not_of(' ');
  if (first == std::string::npos) return "it said nothing";
  return said.substr(first, said.find_last_not_of(' ') - first + 1);
}

int spawn(const std::filesystem::path& program, const std::filesystem::path& folder, const std::string& script, int output,
          pid_t& child) {
  posix_spawn_file_actions_t actions;
  if (const int error = ::posix_spawn_file_actions_init(&actions); error != 0) return error;
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.empty() ? "." : folder.c_str());
  // -d: the defaults, nothing from the user's ~/.gnuplot.
  std::array<std::string, 3> words{program.string(), "-d", script};
  std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
  const int error = ::posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

std::optional<std::filesystem::path> findProgram(const std::string& name, const std::string& search_path) {
  for (std::size_t at = 0; at <= search_path.size();) {
    const std::size_t end = std::min(search_path.find(':', at), search_path.size());
    const std::string folder = search_path.substr(at, end - at);
    at = end + 1;
    if (folder.empty()) continue;
    std::error_code error;
    const std::filesystem::path program = std::filesystem::absolute(std::filesystem::path{folder} / name, error);
    if (!error && std::filesystem::is_regular_file(program, error) && ::access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

Status runGnuplot(const std::filesystem::path& program, const std::filesystem::path& folder, const std::string& script,
                  double patience_s) {
  const auto cannot_start = [&program](int error) {
    return Status{StatusCode::unavailable,
                  "cannot start '" + program.string() + "': " + reasonOf(error) + "; check that gnuplot runs from a terminal"};
  };
  Pipe pipe;
  if (!pipe.open()) return cannot_start(errno);
  pid_t child = 0;
  if (const int error = spawn(program, folder, script, pipe.writing(), child); error != 0) return cannot_start(error);
  pipe.closeWriting();
  std::string said;
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{patience_s});
  if (!readAll(pipe.reading(), deadline, said)) {
    ::kill(child, SIGKILL);
    waitFor(child);
    return {StatusCode::timed_out, "gnuplot did not end in time and was stopped; plot fewer points or allow more time"};
  }
  const int status = waitFor(child);
  if (status >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return {StatusCode::internal, "gnuplot failed on '" + (folder / script).string() + "': " + shown(std::move(said)) +
                                    "; run it there by hand, or check that gnuplot has the terminal pngcairo"};
}

}  // namespace bleedsim::picture
