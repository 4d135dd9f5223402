#include "service/recording/write_queue.h"

#include <condition_variable>
#include <deque>
#include <fmt/core.h>
#include <mutex>
#include <thread>
#include <utility>

#include "service/recording/file_sink.h"
#include "service/recording/mcap_records.h"

namespace bleedsim::recording {

struct WriteQueue::Impl {
  Impl(FileSink opened, const std::filesystem::path& path, std::size_t limit_bytes)
      : file{std::move(opened)}, name{path.string()}, limit{limit_bytes}, thread{[this] { serve(); }} {}

  void serve();
  void stop();

  FileSink file;  // of the thread until that has ended
  const std::string name;
  const std::size_t limit;

  std::mutex mutex;  // covers the following
  std::condition_variable changed;
  std::deque<std::string> blocks;
  std::size_t waiting = 0;  ///< bytes of the blocks and of the one that is being written
  bool ending = false;
  ::bleedsim::Status failure;   ///< of the disk
  ::bleedsim::Status overflow;  ///< the limit was passed

  bool closed = false;  // of the caller
  ::bleedsim::Status closing;
  std::thread thread;
};

void WriteQueue::Impl::serve() {
  std::unique_lock lock{mutex};
  for (;;) {
    changed.wait(lock, [this] { return ending || !blocks.empty(); });
    if (blocks.empty()) return;
    const std::string block = std::move(blocks.front());
    blocks.pop_front();
    lock.unlock();
    ::bleedsim::Status written = file.write(block);
    lock.lock();
    waiting -= block.size();
    if (!written) {
      failure = std::move(written);
      blocks.clear();
      waiting = 0;
    }
    changed.notify_all();
  }
}

void WriteQueue::Impl::stop() {
  if (!thread.joinable()) return;
  {
    const std::lock_guard lock{mutex};
    ending = true;
  }
  changed.notify_all();
  thread.join();
}

Result<WriteQueue> WriteQueue::open(const std::filesystem::path& path, std::size_t limit_bytes) {
  Result<FileSink> file = FileSink::open(path);
  if (!file) return file.status();
  return WriteQueue{std::make_unique<Impl>(std::move(*file), path, limit_bytes)};
}

WriteQueue::WriteQueue(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
WriteQueue::WriteQueue(WriteQueue&&) noexcept = default;

WriteQueue& WriteQueue::operator=(WriteQueue&& other) noexcept {
  if (this != &other) {
    if (impl_) static_cast<void>(close());
    impl_ = std::move(other.impl_);
    bytes_ = other.bytes_;
    crc_ = other.crc_;
  }
  return *this;
}

WriteQueue::~WriteQueue() {
  if (impl_) static_cast<void>(close());
}

::bleedsim::Status WriteQueue::write(std::string block) { return take(std::move(block), false); }
::bleedsim::Status WriteQueue::writeEnd(std::string block) { return take(std::move(block), true); }

::bleedsim::Status WriteQueue::take(std::string block, bool end) {
  if (impl_->closed) return {StatusCode::wrong_state, fmt::format("'{}' is closed", impl_->name)};
  if (block.empty()) return status();
  const std::size_t size = block.size();
  const std::uint32_t crc = mcap::crc32(crc_, mcap::bytesOf(block));
  {
    const std::lock_guard lock{impl_->mutex};
    if (!impl_->failure.ok()) return impl_->failure;
    if (!end && !impl_->overflow.ok()) return impl_->overflow;
    if (!end && impl_->waiting > 0 && impl_->waiting + size > impl_->limit) {
      impl_->overflow = {StatusCode::io,
                         fmt::format("the disk is too slow for '{}': {} kB wait to be written; record to a faster disk, or fewer "
                                     "frames a second. The file is complete up to there",
                                     impl_->name, (impl_->waiting + size) / 1000)};
    }
    impl_->waiting += size;
    impl_->blocks.push_back(std::move(block));
  }
  bytes_ += size;
  crc_ = crc;
  impl_->changed.notify_all();
  return {};
}

::bleedsim::Status WriteQueue::flush() {
  std::unique_lock lock{impl_->mutex};
  impl_->changed.wait(lock, [this] { return impl_->waiting == 0; });
  return impl_->failure;
}

::bleedsim::Status WriteQueue::close() {
  if (!impl_->closed) {
    impl_->closed = true;
    impl_->stop();
    const ::bleedsim::Status stored = impl_->file.close();
    impl_->closing = stored ? impl_->overflow : stored;
  }
  return impl_->closing;
}

::bleedsim::Status WriteQueue::status() const {
  const std::lock_guard lock{impl_->mutex};
  return impl_->failure ? impl_->overflow : impl_->failure;
}

}  // namespace bleedsim::recording
