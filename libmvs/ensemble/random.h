// Random numbers with the same bits on every machine, which <random> does not guarantee.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/math.h"
#include "base/types.h"

namespace mvs::core {

// splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
class Random {
 public:
  // Streams of one seed are independent.
  Random(uint64_t seed, uint64_t stream) : state_(seed) {
    state_ = next() ^ (stream * 0xd1342543de82ef95u);
  }

  uint64_t next() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  // In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  // A uniform direction: height and longitude are uniform (Archimedes).
  Vec3 direction() {
    const double z = 2 * uniform() - 1, turn = 6.283185307179586 * uniform();
    const double r = std::sqrt(1 - z * z);
    return {r * math::cos(turn), r * math::sin(turn), z};
  }

 private:
  uint64_t state_;
};

}  // namespace mvs::core
