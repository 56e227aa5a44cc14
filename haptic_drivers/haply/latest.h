// The latest of what one thread gives to another, neither of which ever waits: three places, of
// which each has one and the third is exchanged.
#pragma once

#include <atomic>

namespace haply {

template <typename T>
class Latest {
 public:
  // Of the one thread that gives.
  void put(const T &value) {
    places_[giving_] = value;
    giving_ = between_.exchange(giving_ | kNew, std::memory_order_acq_rel) & ~kNew;
  }
  // Of the one that takes; valid until it takes again.
  const T &get() {
    if (between_.load(std::memory_order_relaxed) & kNew)
      taking_ = between_.exchange(taking_, std::memory_order_acq_rel) & ~kNew;
    return places_[taking_];
  }

 private:
  static constexpr unsigned kNew = 4;

  T places_[3] = {};
  unsigned giving_ = 0, taking_ = 1;
  std::atomic<unsigned> between_{2};
};

}  // namespace haply
