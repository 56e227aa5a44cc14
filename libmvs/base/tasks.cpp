// The shares of all tasks under a mutex; the calling thread tells their mean.
#include "base/tasks.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "base/workers.h"

namespace mvs::core {
namespace {

class SharesOfTasks {
 public:
  SharesOfTasks(uint32_t count, const TellShare &tell) : tell_(tell), done_(count, 0) {}

  void tell(uint32_t task, double share) {
    const double mean = mean_after(task, share);
    if (!tell_ || std::this_thread::get_id() != caller_) return;
    try {
      tell_(mean);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      ended_ = std::current_exception();
      throw;
    }
  }

 private:
  // Throws if the call has been ended.
  double mean_after(uint32_t task, double share) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ended_) std::rethrow_exception(ended_);
    done_[task] = std::max(done_[task], share);
    return std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size());
  }

  const TellShare &tell_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::mutex mutex_;  // protects the next two
  std::vector<double> done_;
  std::exception_ptr ended_;
};

}  // namespace

void run_tasks(Workers *workers, uint32_t count, const TellShare &tell,
               const std::function<void(uint32_t, const TellShare &)> &run) {
  SharesOfTasks shares(count, tell);
  const auto run_one = [&](uint32_t task) {
    run(task, [&](double share) { shares.tell(task, share); });
    shares.tell(task, 1);
  };
  if (workers != nullptr) {
    workers->parallel_for(count, run_one);
  } else {
    for (uint32_t task = 0; task < count; ++task) run_one(task);
  }
}

}  // namespace mvs::core
