#include "service/sph/executor.h"

#ifdef BLEEDSIM_STD_THREADS
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#endif

#include "service/sph/flush_to_zero.h"

namespace bleedsim::sph {
namespace {

class SerialExecutor final : public Executor {
 public:
  SerialExecutor() : Executor{1} {}

 private:
  void runShares(int shares, ShareFunction function, void* context) override {
    const FlushToZero scope;
    for (int share = 0; share < shares; ++share) function(context, share);
  }
};

#ifdef BLEEDSIM_STD_THREADS

// ThreadSanitizer reports false races inside Debian's oneTBB; its build takes plain threads behind the same interface.
class ThreadExecutor final : public Executor {
 public:
  explicit ThreadExecutor(int threads) : Executor{threads} {
    for (int worker = 1; worker < threads; ++worker) workers_.emplace_back([this, worker] { work(worker); });
  }
  ~ThreadExecutor() override {
    {
      const std::lock_guard lock{mutex_};
      stop_ = true;
    }
    start_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

 private:
  void runShares(int shares, ShareFunction function, void* context) override {
    {
      const std::lock_guard lock{mutex_};
      shares_ = shares;
      function_ = function;
      context_ = context;
      busy_ = threads() - 1;
      ++generation_;
    }
    start_.notify_all();
    execute(0, shares, function, context);
    std::unique_lock lock{mutex_};
    done_.wait(lock, [this] { return busy_ == 0; });
  }
  void execute(int worker, int shares, ShareFunction function, void* context) const {
    const FlushToZero scope;
    for (int share = worker; share < shares; share += threads()) function(context, share);
  }
  void work(int worker) {
    unsigned seen = 0;
    std::unique_lock lock{mutex_};
    for (;;) {
      start_.wait(lock, [&] { return stop_ || generation_ != seen; });
      if (stop_) return;
      seen = generation_;
      const int shares = shares_;
      const ShareFunction function = function_;
      void* const context = context_;
      lock.unlock();
      execute(worker, shares, function, context);
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable start_, done_;
  std::vector<std::thread> workers_;
  unsigned generation_ = 0;
  int busy_ = 0;
  int shares_ = 0;
  ShareFunction function_ = nullptr;
  void* context_ = nullptr;
  bool stop_ = false;
};

#else

class ThreadExecutor final : public Executor {
 public:
  explicit ThreadExecutor(int threads) : Executor{threads}, arena_{threads} {}

 private:
  void runShares(int shares, ShareFunction function, void* context) override {
    if (shares == 1) {  // waking the arena costs more than a small pass
      const FlushToZero scope;
      function(context, 0);
      return;
    }
    // The static partitioner hands each thread the same share in every pass, so its part of the arrays stays in its cache.
    arena_.execute([&] {
      tbb::parallel_for(
          0, shares, 1,
          [&](int share) {
            const FlushToZero scope;
            function(context, share);
          },
          tbb::static_partitioner{});
    });
  }

  tbb::task_arena arena_;
};

#endif

}  // namespace

std::unique_ptr<Executor> makeExecutor(int threads) {
  if (threads <= 1) return std::make_unique<SerialExecutor>();
  return std::make_unique<ThreadExecutor>(threads);
}

}  // namespace bleedsim::sph
