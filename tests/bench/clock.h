// CPU seconds of this process beside wall-clock seconds: other work on the machine adds much to the
// second, little to the first.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace bench {

struct Seconds {
  double cpu = 0, wall = 0;
};

inline double read_clock(clockid_t clock) {
  timespec now = {};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

inline double cpu_now() {
  return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

// The cost of a piece of work.
template <typename Work>
Seconds timed(Work &&work) {
  const double wall = read_clock(CLOCK_MONOTONIC), cpu = cpu_now();
  work();
  return {cpu_now() - cpu, read_clock(CLOCK_MONOTONIC) - wall};
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The CPU seconds of the fastest of `rounds`, each of as many calls as take a millisecond: other
// work on the machine only ever adds.
template <typename Work>
double fastest(int rounds, Work &&work) {
  int calls = 1;
  double best = timed(work).cpu;
  if (best < 1e-3) calls = static_cast<int>(std::min(1e-3 / std::max(best, 1e-7), 1e4)) + 1;
  for (int k = 0; k < rounds; ++k) {
    const double took = timed([&] {
                          for (int c = 0; c < calls; ++c) work();
                        }).cpu;
    best = std::min(best, took / calls);
  }
  return best;
}

}  // namespace bench
