// Closures per core-second of many variants of one valve.
//
//   bench_throughput                           200 variants of S: one process, two threads, a pool
//   bench_throughput --variants 10000 --csv FILE
//   bench_throughput --scene M --measure
//
// Each variant is closed in a simulator of its own, made for it. "apart": in an empty one;
// "family": in one that was restored to a snapshot of the valve, so that its variants share what
// depends on the mesh. The digest, the same for both, covers the states that were found. CPU time
// of the threads or processes at work, which depends little on other work on the machine.
#include <mvs/experimental.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/bench/closing.h"
#include "tests/bench/table.h"
#include "tests/bench/variants.h"

namespace {

struct Options {
  std::string scene = "S", leaflet = "spring", csv;
  uint32_t variants = 200, threads = 2, processes = 2;
  bool measures = false;
};

// The sums over some variants; plain data, which a process sends through a pipe.
struct Sums {
  uint32_t variants = 0, at_rest = 0;
  double cpu = 0;       // s, of all
  double set_up = 0;    // s: simulator, valve and load
  double ordering = 0;  // s: elimination orders and their analysis
  double other = 0;     // s in no phase: coarse meshes, transfers, crossing tests, stability
  uint64_t digest = 0;

  void add(const Sums &s) {
    variants += s.variants;
    at_rest += s.at_rest;
    cpu += s.cpu;
    set_up += s.set_up;
    ordering += s.ordering;
    other += s.other;
    digest ^= s.digest;
  }
};

double thread_cpu() {
  return bench::read_clock(CLOCK_THREAD_CPUTIME_ID);
}

mvs::Snapshot open_valve(const Options &options) {
  mvs::Simulator sim;
  mvs_parametric_desc valve = {};
  valve.shape = MVS_SHAPE_FOUNDING;
  valve.vertices = bench::scene_vertices.at(options.scene);
  sim.generate(valve);
  if (options.leaflet == "membrane") {
    mvs_leaflet_desc tissue = {};
    tissue.law = MVS_LEAFLET_LAW_BILINEAR;
    sim.set_leaflet(tissue);
  }
  return sim.snapshot();
}

Sums close_one(const Options &options, const bench::Variants &variants, const mvs::Snapshot *like,
               uint32_t number) {
  Sums sums;
  const double start = thread_cpu();
  mvs::Simulator sim;
  if (like) sim.restore(*like);
  variants.set(sim, number);
  const double set = thread_cpu();
  mvs_settle_options how = {};
  how.residual = bench::rest_residual;
  const double wall = bench::read_clock(CLOCK_MONOTONIC);
  const mvs_stats stats = sim.settle(how);
  const double took = bench::read_clock(CLOCK_MONOTONIC) - wall;
  const double settled = thread_cpu();
  const mvs::Snapshot closed = sim.snapshot();
  if (options.measures) closed.measure();
  sums.cpu = thread_cpu() - start;
  sums.set_up = set - start;
  const mvs_profile profile = mvs::profile_of(sim);
  double in_phases = 0;
  for (size_t k = 0; k < bench::phase_names.size(); ++k) in_phases += profile.phase_s[k];
  // phases are timed by the wall clock
  const double cpu_of_wall = (settled - set) / took;
  sums.ordering = profile.phase_s[MVS_PHASE_ORDERING] * cpu_of_wall;
  sums.other = settled - set - in_phases * cpu_of_wall;
  sums.variants = 1;
  sums.at_rest = stats.converged;
  sums.digest = closed.hash()[0];
  return sums;
}

// Every `of`-th variant, from the one of this number on.
Sums close_share(const Options &options, const mvs::Snapshot &open, bool family, uint32_t first,
                 uint32_t of) {
  const bench::Variants variants(open);
  Sums sums;
  for (uint32_t k = first; k < options.variants; k += of)
    sums.add(close_one(options, variants, family ? &open : nullptr, k));
  return sums;
}

Sums on_threads(const Options &options, const mvs::Snapshot &open, bool family, uint32_t count) {
  std::vector<Sums> each(count);
  std::vector<std::exception_ptr> failed(count);
  std::vector<std::thread> threads;
  for (uint32_t k = 0; k < count; ++k) {
    threads.emplace_back([&, k] {
      try {
        each[k] = close_share(options, open, family, k, count);
      } catch (...) {
        failed[k] = std::current_exception();
      }
    });
  }
  for (std::thread &thread : threads) thread.join();
  Sums sums;
  for (uint32_t k = 0; k < count; ++k) {
    if (failed[k]) std::rethrow_exception(failed[k]);
    sums.add(each[k]);
  }
  return sums;
}

// A process that makes the valve itself, as a pool's process would, and sends its sums.
void work_in_child(const Options &options, bool family, uint32_t k, int to) {
  int failed = 1;
  try {
    const Sums sums = close_share(options, open_valve(options), family, k, options.processes);
    failed = write(to, &sums, sizeof sums) != sizeof sums;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_throughput: %s\n", error.what());
  }
  _exit(failed);
}

Sums in_processes(const Options &options, bool family) {
  std::vector<int> from;
  for (uint32_t k = 0; k < options.processes; ++k) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("could not make a pipe");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("could not make a process");
    if (child == 0) work_in_child(options, family, k, ends[1]);
    close(ends[1]);
    from.push_back(ends[0]);
  }
  Sums sums;
  for (const int end : from) {
    Sums of_child;
    if (read(end, &of_child, sizeof of_child) != sizeof of_child)
      throw std::runtime_error("a process of the pool failed");
    sums.add(of_child);
    close(end);
  }
  while (wait(nullptr) > 0) continue;
  return sums;
}

template <typename Work>
void tell(bench::Table &table, const char *pool, uint32_t workers, bool family, Work &&work) {
  Sums s;
  const double wall = bench::timed([&] { s = work(); }).wall;
  char digest[20];
  std::snprintf(digest, sizeof digest, "%016llx", static_cast<unsigned long long>(s.digest));
  table.row({pool, workers, family ? "family" : "apart", s.variants, s.at_rest, s.cpu, wall,
             s.variants / s.cpu, 100 * s.set_up / s.cpu, 100 * s.ordering / s.cpu,
             100 * s.other / s.cpu, digest});
}

void run(const Options &options) {
  bench::Table table({"pool     ", "workers", "mesh   ", "variants", "at rest", "cpu s", "wall s",
                      "per core-s", "set up %", "ordering %", "other %", "digest          "},
                     options.csv);
  // processes first: a process with threads should not be copied
  for (const bool family : {false, true}) {
    if (options.processes > 0)
      tell(table, "processes", options.processes, family,
           [&] { return in_processes(options, family); });
  }
  const mvs::Snapshot open = open_valve(options);
  std::vector<uint32_t> counts = {1};
  if (options.threads > 1) counts.push_back(options.threads);
  for (const uint32_t count : counts) {
    for (const bool family : {false, true})
      tell(table, "threads", count, family,
           [&] { return on_threads(options, open, family, count); });
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("Closures per core-second of variants of one valve.", "bench_throughput");
    app.add_option("--scene", options.scene, "S 425, M 1700, L 6800, XL 27000 vertices")
        ->capture_default_str()
        ->check(CLI::IsMember(bench::keys(bench::scene_vertices)));
    app.add_option("--leaflet", options.leaflet, "tissue")
        ->capture_default_str()
        ->check(CLI::IsMember({"spring", "membrane"}));
    app.add_option("--variants", options.variants, "of each row of the table")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--threads", options.threads, "of one process, beside a row of one thread")
        ->capture_default_str()
        ->check(CLI::Range(0, 256));
    app.add_option("--processes", options.processes, "of the pool; 0: leave it out")
        ->capture_default_str()
        ->check(CLI::Range(0, 256));
    app.add_flag("--measure", options.measures, "measure each closed valve as well");
    app.add_option("--csv", options.csv, "file to write the table to");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_throughput: %s\n", error.what());
    return 1;
  }
}
