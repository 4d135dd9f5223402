#include "service/lab/side_by_side.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

namespace bleedsim::lab {

void runSideBySide(std::size_t jobs, int threads, const std::function<void(std::size_t)>& job,
                   const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t finished = 0;
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs; k = next++) {
      job(k);
      const std::lock_guard lock{mutex};
      done(++finished);
    }
  };
  std::vector<std::jthread> workers;
  const std::size_t wanted = std::min(jobs, static_cast<std::size_t>(std::max(1, threads)));
  for (std::size_t k = 1; k < wanted; ++k) workers.emplace_back(work);
  work();
}

}  // namespace bleedsim::lab
