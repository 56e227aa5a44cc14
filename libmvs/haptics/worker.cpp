// Worker thread with a queue of one item.
#include "haptics/worker.h"

#include <condition_variable>
#include <mutex>
#include <system_error>

#include "base/error.h"
#include "base/own_faults_only.h"
#include "haptics/library_reference.h"

namespace mvs::core {

struct Worker::Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::function<void()> work;
  bool busy = false, over = false;

  void serve() {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return over || work; });
      if (!work) return;
      std::function<void()> now = std::move(work);
      work = nullptr;
      lock.unlock();
      now();
      now = nullptr;  // may destroy the owner of this worker: not with the lock held
      lock.lock();
      busy = false;
      changed.notify_all();
    }
  }
};

// The reference is taken before the thread may hang in a constructor of a library, which blocks
// dlopen.
Worker::Worker(const std::string &driver)
    : shared_(std::make_shared<Shared>()), library_(hold_library()) {
  try {
    const OwnFaultsOnly blocked;
    thread_ = std::thread([shared = shared_] { shared->serve(); });
  } catch (const std::system_error &error) {
    release_library(library_);
    fail(MVS_E_MEMORY, driver,
         "%s: the system starts no thread for its driver (%s): end other programs, and try again",
         driver.c_str(), error.code().message().c_str());
  } catch (...) {
    release_library(library_);
    throw;
  }
}

// A stuck thread owns its work, ends when the work returns, and may be the one that destroys this.
Worker::~Worker() {
  {
    const std::lock_guard<std::mutex> lock(shared_->mutex);
    shared_->over = true;
    shared_->changed.notify_all();
  }
  if (stuck_) {
    thread_.detach();
  } else {
    thread_.join();
    if (!keeps_library_) release_library(library_);
  }
}

bool Worker::run(std::function<void()> work, std::chrono::milliseconds timeout) {
  if (stuck_) return false;
  std::unique_lock<std::mutex> lock(shared_->mutex);
  shared_->work = std::move(work);
  shared_->busy = true;
  shared_->changed.notify_all();
  stuck_ = !shared_->changed.wait_for(lock, timeout, [&] { return !shared_->busy; });
  return !stuck_;
}

}  // namespace mvs::core
