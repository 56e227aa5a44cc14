// Pseudo-random numbers that are the same on every machine.
#pragma once

#include <cstdint>

namespace mvs::core {

// Nearly normal deviates: sums of twelve uniform ones (Irwin and Hall), from a linear congruential
// generator (Knuth, MMIX). None is beyond 6 standard deviations.
class NormalNumbers {
 public:
  explicit NormalNumbers(uint64_t seed) : state_(seed) {}

  double next() {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += uniform();
    return sum;
  }
  double uniform() {
    state_ = 6364136223846793005u * state_ + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

}  // namespace mvs::core
