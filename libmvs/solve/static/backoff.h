// Exponential backoff: an attempt that fails is left out for one iteration, after each further
// failure for twice as many, up to a limit.
#pragma once

#include <algorithm>

namespace mvs::core {

class Backoff {
 public:
  // To be called once an iteration. Returns whether the attempt is left out in it.
  bool waits() {
    if (wait_ == 0) return false;
    --wait_;
    return true;
  }
  void succeeded() { *this = {}; }
  // `longest`: iterations.
  void failed(int longest) {
    wait_ = length_;
    length_ = std::min(2 * length_, longest);
  }

 private:
  int wait_ = 0;    // iterations until the next attempt
  int length_ = 1;  // of the next wait
};

}  // namespace mvs::core
