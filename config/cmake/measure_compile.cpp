// Compiler launcher that notes beside the object what a compilation took: CPU seconds and the largest process' memory.
//
//   measure_compile PART COMMAND...
//
// Where the object's path (after -o) holds PART, OBJECT.cost gets one line: seconds, KiB and "compiled", or "cached" where ccache
// had the object; the figures are then those of the last compilation in this folder, or "-". Everything else just runs.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr int kCannotRun = 127;

std::string objectOf(char** command) {
  for (char** word = command; *word != nullptr && word[1] != nullptr; ++word) {
    if (std::string{*word} == "-o") return word[1];
  }
  return {};
}

std::string contentOf(const std::string& path) {
  std::ifstream file{path};
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

double secondsOf(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

std::string figures(const std::string& cost_file, bool cached, const rusage& use) {
  std::ostringstream text;
  if (!cached) {
    text << std::fixed << std::setprecision(1) << secondsOf(use.ru_utime) + secondsOf(use.ru_stime) << ' ' << use.ru_maxrss;
    return text.str();
  }
  std::string seconds, memory;
  std::istringstream before{contentOf(cost_file)};
  if (!(before >> seconds >> memory)) return "- -";
  return seconds + ' ' + memory;
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) return kCannotRun;
  char** command = arguments + 2;
  const std::string object = objectOf(command);
  if (object.find(arguments[1]) == std::string::npos) {
    execvp(command[0], command);
    return kCannotRun;
  }
  const std::string cost_file = object + ".cost";
  const std::string log_file = object + ".ccache";
  std::remove(log_file.c_str());
  setenv("CCACHE_STATSLOG", log_file.c_str(), 1);
  const pid_t child = fork();
  if (child == 0) {
    execvp(command[0], command);
    _exit(kCannotRun);
  }
  int status = 0;
  rusage use{};
  if (child < 0 || wait4(child, &status, 0, &use) != child) return kCannotRun;
  const bool cached = contentOf(log_file).find("cache_hit") != std::string::npos;
  std::remove(log_file.c_str());
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    const std::string line = figures(cost_file, cached, use);
    std::ofstream{cost_file} << line << (cached ? " cached\n" : " compiled\n");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kCannotRun;
}
