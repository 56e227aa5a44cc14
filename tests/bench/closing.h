// One closure from open through include/mvs, as an application closes a valve.
#pragma once

#include <mvs/profile.h>
#include <mvs/snapshot.h>

#include <map>
#include <string>
#include <vector>

#include "tests/bench/clock.h"

namespace bench {

// Scenes by name: the default valve with their number of vertices.
inline const std::map<std::string, uint32_t> scene_vertices = {
    {"S", 425}, {"M", 1700}, {"L", 6800}, {"XL", 27000}};
inline const std::map<std::string, uint32_t> solver_names = {{"newton", MVS_SOLVER_NEWTON},
                                                             {"implicit", MVS_SOLVER_IMPLICIT},
                                                             {"explicit", MVS_SOLVER_EXPLICIT}};
inline const std::vector<std::string> phase_names = {"terms",    "broad",  "narrow", "assembly",
                                                     "ordering", "factor", "solve",  "line_search"};

// The out-of-balance force on a node below which a valve is at rest, N; every benchmark closes to
// it.
inline constexpr double rest_residual = 1e-4;

struct Case {
  std::string scene = "S", leaflet = "spring", solver = "newton";
  double residual = rest_residual;
  double dt = 0, damping = 0;  // of solvers in time; 0: the default
  uint32_t most = 0;           // iterations; 0: the default
  uint32_t workers = 0;        // threads; 0 and 1: the calling thread alone
  std::string file = "";       // a valve with its load; empty: the scene, under systolic pressure
};

struct Closing {
  size_t vertices = 0;    // of the leaflets
  bool diverged = false;  // a value is not finite; later results are then meaningless
  mvs_stats stats = {};   // of the last run
  mvs_profile profile = {};
  mvs_measures measures = {};
  std::vector<double> cpu_s, wall_s;  // of each run
  std::string closed;                 // the last shape, an extended OBJ file

  bool at_rest() const { return !diverged && stats.converged != 0; }
  double cpu() const { return median(cpu_s); }
  double wall() const { return median(wall_s); }
  // CPU seconds of a phase of the last run: its share of the wall time of that run, times the CPU
  // time.
  double phase(size_t k) const { return profile.phase_s[k] / wall_s.back() * cpu(); }
  // Time in no phase: coarser meshes and transfers between them, crossing tests, the solver's own
  // vectors, the check of stability.
  double other() const;
};

// The share of the CPU time of a closure that its `workers` may share, from 0 to 1: that of the
// loops that a pool of the host runs, here all on the calling thread, so that load does not matter.
double shared_part(const Case &of);

// Closes it `repeat` times, each in a new simulator, so that no run starts from another's cached
// data.
Closing close(const Case &of, int repeat);
// The same of several cases, in turn, so that other work on the machine meets all of them.
std::vector<Closing> close_in_turn(const std::vector<Case> &cases, int repeat);

// The valve before it is closed, an extended OBJ file.
std::string open_valve(const Case &of);
// Sets `measures` and `vertices` from the closed shape, if there is one.
void measure(Closing &closing);
// Distances between the surfaces of two closed shapes.
mvs_comparison distance(const std::string &a, const std::string &b);

// The keys of a map, for options.
template <typename Map>
std::vector<std::string> keys(const Map &map) {
  std::vector<std::string> names;
  names.reserve(map.size());
  for (const auto &entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace bench
