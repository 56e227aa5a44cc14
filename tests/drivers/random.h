// SplitMix64 (Steele, Lea & Flood 2014): the same numbers on every machine.
#pragma once

#include <cstdint>

struct Random {
  uint64_t state;

  uint32_t operator()() {
    uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<uint32_t>((z ^ (z >> 31)) >> 32);
  }
};
