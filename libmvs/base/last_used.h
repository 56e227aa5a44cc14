// The last few values of an expensive function, kept for the whole process.
#pragma once

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace mvs::core {

// From any thread. Values are copied out: a shared pointer to something that does not change.
template <typename Value, size_t most>
class LastUsed {
 public:
  // Returns the value for which is_it(value) is true, or make(), which takes the place of the value
  // that was used longest ago.
  template <typename IsIt, typename Make>
  Value find(const IsIt &is_it, const Make &make) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto found = std::find_if(values_.begin(), values_.end(), is_it);
      if (found != values_.end()) {
        std::rotate(found, found + 1, values_.end());
        return values_.back();
      }
    }
    // outside of the lock: two threads may make the same value; both are right
    Value made = make();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (values_.size() == most) values_.erase(values_.begin());
    values_.push_back(made);
    return made;
  }

 private:
  std::mutex mutex_;
  std::vector<Value> values_;  // the last used one last
};

}  // namespace mvs::core
