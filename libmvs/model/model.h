// Model, State and Snapshot: the three things that everything else is made of.
#pragma once

#include <memory>
#include <vector>

#include "model/solver_cache.h"
#include "model/tool.h"
#include "model/topology.h"
#include "model/valve.h"

namespace mvs::core {

// An immutable valve with what follows from it. Made by make_model, shared by every snapshot.
struct Model {
  Valve valve;
  Topology topology;
  CowVector<double> rest_area;    // m2 per triangle
  CowVector<double> rest_length;  // m per edge
  CowVector<double> vertex_area;  // m2 per node: a third of its rest triangles
  CowVector<double> node_mass;    // kg: lumped from triangles and chordae
  uint64_t serial = 0;  // of this process: tells a new model from one that lay at its address

  size_t node_count() const { return valve.rest.size(); }
  // Where a prescribed node is at a fraction 0 (open) .. 1 (loaded) of the boundary motion.
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
  CowVector<Tool> tools;    // in the order in which they were added
  uint64_t tools_made = 0;  // so far; no id is given twice
  SolverCache cache;        // of live steps; empty after settling or an operation

  void drop_cache() { cache = {}; }
};

// A model and a state of it.
struct ModelState {
  ModelPtr model;
  State state;
};

// Checks, completes (ids, names, fibres, thickness) and freezes a valve; throws the first fault.
// Arrays that hold the same as those of `parent` (nullable) are shared with it.
ModelPtr make_model(Valve valve, const Model *parent = nullptr);

// Shares with `other` the arrays that hold the same bits; nothing else changes.
void share(Model &model, const Model &other);
void share(State &state, const State &other);

// The state a new valve starts from: at rest, no load.
State initial_state(const Model &model);

// 128 bits over the meaning of both: names, numbers, order; never addresses or padding.
std::array<uint64_t, 2> hash_of(const Model &model, const State &state);

}  // namespace mvs::core
