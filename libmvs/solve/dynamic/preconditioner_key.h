// The contents of a solver cache: which matrices the cached preconditioners of live steps were
// factorised from. A key holds every input of such a matrix, so that a solver without the factor
// makes it again with the same bits.
#pragma once

#include "model/model.h"

namespace mvs::core {

// A configuration of the valve and the parameters of the step matrix there.
struct PreconditionerKey {
  CowVector<Vec3> x;      // m, nodes followed by the points of the tools; empty: no key
  CowVector<Tool> tools;  // at that time
  double pressure = 0;    // Pa
  double dt = 0;          // s
  double damping = 0;     // 1/s, mass-proportional
  uint32_t age = 0;       // active: steps it has served; pending: parts of its factor that are done

  bool empty() const { return x.empty(); }
};

// The preconditioner that serves the steps, and the one that is factorised beside them.
struct PreconditionerKeys {
  PreconditionerKey active, pending;
};

// Overwrites `data` with both keys and returns a cache that shares it; the counter holds the ages.
// Without an active key the cache is empty.
SolverCache pack(const PreconditionerKeys &keys, CowVector<double> &data);

// The ages of both keys, as the counter of a cache holds them.
uint64_t packed_ages(const PreconditionerKeys &keys);
void unpack_ages(uint64_t counter, PreconditionerKeys &keys);

// Returns the keys of a cache. `valve_nodes` is the node count of the model without the points of
// tools. Throws MVS_E_VERSION for another layout and MVS_E_FORMAT for numbers that are not a cache
// of this model.
PreconditionerKeys unpack(const SolverCache &cache, const Model &model, size_t valve_nodes);

}  // namespace mvs::core
