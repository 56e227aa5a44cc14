// Model, State and ModelState: an immutable valve with derived data, and one state of it.
#pragma once

#include <memory>
#include <vector>

#include "model/mesh_family.h"
#include "model/solver_cache.h"
#include "model/tool.h"
#include "model/topology.h"
#include "model/valve.h"

namespace mvs::core {

// An immutable valve with its derived data. make_model makes it; snapshots share it.
struct Model {
  Valve valve;
  Topology topology;
  CowVector<double> rest_area;         // m2 per triangle
  CowVector<double> rest_length;       // m per edge
  CowVector<double> vertex_area;       // m2 per node: a third of its rest triangles
  CowVector<double> node_mass;         // kg: lumped from triangles and chordae
  std::shared_ptr<MeshFamily> family;  // with all variants of the valve
  uint64_t serial =
      0;  // unique in this process, so that a new model at an old address is recognised

  size_t node_count() const { return valve.rest.size(); }
  // Position of a prescribed node at a fraction 0 (open) .. 1 (loaded) of the boundary motion.
  Vec3 target(uint32_t node, double fraction) const {
    return valve.open[node] + fraction * (valve.loaded[node] - valve.open[node]);
  }
};

using ModelPtr = std::shared_ptr<const Model>;

struct Load {
  double pressure = 0;           // Pa
  double boundary_fraction = 0;  // 0 open .. 1 loaded
};

// Every input of the next step.
struct State {
  CowVector<Vec3> x;  // m
  CowVector<Vec3> v;  // m/s
  double time = 0;    // s
  uint64_t steps = 0;
  Load load;
  CowVector<Tool> tools;    // in the order of addition
  uint64_t tools_made = 0;  // count of all tools added so far; ids are not reused
  SolverCache cache;        // of live steps; empty after settling or an operation
  // N, the out-of-balance force at which a solver found this state at rest under its load; 0: not
  // at rest, or not known to be. Every change of model, load, tools or positions makes it 0.
  double rest_tolerance = 0;

  bool is_at_rest() const { return rest_tolerance > 0; }
  void drop_cache() { cache = {}; }
};

// A model with one of its states.
struct ModelState {
  ModelPtr model;
  State state;
};

// Checks a valve, fills in its defaults (ids, names, fibres, thickness) and derives the rest.
// Throws the first fault. Arrays equal to those of `parent` (may be null) share their memory with
// it; a valve with its mesh takes topology, areas and the checks of the mesh from it.
ModelPtr make_model(Valve valve, const Model *parent = nullptr);

// Returns the number of nodes with triangles.
size_t sheet_vertices(const Model &model);

// Returns the mean length of the edges at rest, m.
double mean_edge(const Model &model);

// Makes arrays that have the same bits as those of `other` share their memory; no value changes.
void share(Model &model, const Model &other);
void share(State &state, const State &other);

// The initial state of a valve: rest shape, zero velocity, no load.
State initial_state(const Model &model);

// A 128-bit hash of all values of both (names, numbers, order), independent of addresses and
// padding.
std::array<uint64_t, 2> hash_of(const Model &model, const State &state);

}  // namespace mvs::core
