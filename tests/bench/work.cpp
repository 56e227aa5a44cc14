// A fixed piece of work to count instructions of (instructions.py), not to time: closes the default
// valve, steps it, measures it, saves and loads it.
//
//   bench_work FILE                  FILE is written, read and left there
#include <cstdio>
#include <exception>
#include <mvs/mvs.hpp>

#include "tests/founding.h"

int main(int argc, char **argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: bench_work FILE");
    mvs::Simulator sim;
    sim.generate(founding_valve());
    sim.set_load(MVS_SYSTOLE_PA);
    const mvs_stats stats = sim.settle();
    for (int k = 0; k < 5; ++k) sim.step();
    const mvs::Snapshot snapshot = sim.snapshot();
    const mvs_measures measures = snapshot.measure();
    snapshot.save(argv[1]);
    sim.load_file(argv[1]);
    std::printf("%u iterations, at rest: %u, crossings: %u\n", stats.iterations, stats.converged,
                measures.intersections);
    return stats.converged != 0 ? 0 : 1;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_work: %s\n", error.what());
    return 1;
  }
}
