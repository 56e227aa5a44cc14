// Triple buffer: hands the latest value from one thread to another without waiting.
#pragma once

#include <atomic>

namespace haply {

template <typename T>
class Latest {
 public:
  // For the writing thread.
  void put(const T &value) {
    slots_[writing_] = value;
    writing_ = shared_.exchange(writing_ | kNew, std::memory_order_acq_rel) & ~kNew;
  }
  // For the reading thread; the reference is valid until its next call.
  const T &get() {
    if (shared_.load(std::memory_order_relaxed) & kNew)
      reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & ~kNew;
    return slots_[reading_];
  }

 private:
  static constexpr unsigned kNew = 4;

  T slots_[3] = {};
  unsigned writing_ = 0, reading_ = 1;
  std::atomic<unsigned> shared_{2};
};

}  // namespace haply
