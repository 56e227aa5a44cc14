// 128-bit hash of a sequence of words, which distinguishes inputs; not for security.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "base/bit_cast.h"

namespace mvs::core {

// Two independent 64-bit states. A word changes each of them by xor, a product with an odd number
// and a shift, all of which are invertible: inputs that differ in one word alone never collide.
// Doubles count by their bits: -0.0 and 0.0 are different inputs, because a step may distinguish
// them (1/x, copysign). Lengths precede contents, so that "ab","c" differs from "a","bc".
class Hash {
 public:
  void add(uint64_t word) {
    a_ = (a_ ^ word) * 0x9e3779b97f4a7c15u;
    a_ ^= a_ >> 32;
    b_ = (b_ ^ std::rotl(word, 29)) * 0xc2b2ae3d27d4eb4fu;
    b_ ^= b_ >> 29;
  }
  void add(double number) { add(bit_cast<uint64_t>(number)); }
  void add(std::string_view text) {
    add(uint64_t{text.size()});
    for (const char c : text) add(uint64_t{static_cast<unsigned char>(c)});
  }
  std::array<uint64_t, 2> value() const { return {finish(a_), finish(b_ ^ std::rotl(a_, 17))}; }

 private:
  // The finaliser of splitmix64 (Steele, Lea, Flood 2014): every bit in reaches every bit out.
  static uint64_t finish(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }

  uint64_t a_ = 0x243f6a8885a308d3u, b_ = 0x13198a2e03707344u;  // digits of pi
};

}  // namespace mvs::core
