// Runs the shares of a pass on worker threads. What a share computes never depends on which thread runs it or how many there are.
#pragma once

#include <memory>
#include <type_traits>

namespace bleedsim::sph {

class Executor {
 public:
  virtual ~Executor() = default;

  int threads() const { return threads_; }

  /// Calls task(share) for every share in [0, shares) and returns when all are done. `task` must not throw. Every call runs with
  /// flush-to-zero set: denormals would slow a stage a hundredfold.
  template <class Task>
  void run(int shares, Task&& task) {
    using Plain = std::remove_reference_t<Task>;
    runShares(
        shares, [](void* context, int share) { (*static_cast<Plain*>(context))(share); }, &task);
  }

 protected:
  using ShareFunction = void (*)(void* context, int share);
  explicit Executor(int threads) : threads_{threads} {}
  virtual void runShares(int shares, ShareFunction function, void* context) = 0;

 private:
  int threads_;
};

/// An executor of its own for each world, capped at `threads`.
std::unique_ptr<Executor> makeExecutor(int threads);

}  // namespace bleedsim::sph
