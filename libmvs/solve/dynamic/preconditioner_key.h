// The contents of a solver cache: which matrices the cached preconditioners of live steps were
// factorised from. A key holds every input of such a matrix, so that a solver without the factor
// makes it again with the same bits.
#pragma once

#include <array>
#include <utility>

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

// Returns the keys of a cache. `valve_nodes` is the node count of the model without the points of
// tools. Throws MVS_E_VERSION for another layout and MVS_E_FORMAT for numbers that are not a cache
// of this model.
PreconditionerKeys unpack(const SolverCache &cache, const Model &model, size_t valve_nodes);

// The keys of the state at work. Packs them only when more than their ages changed, into buffers
// that it uses again, so that a warm step allocates nothing and most steps copy nothing.
class KeyStore {
 public:
  // Allocates memory for two keys of this many nodes without tools.
  void reserve(size_t nodes);
  // Reads the cache of a state; see unpack(). `state` has the nodes of `model`, points included.
  void load(const State &state, const Model &model);
  // Writes the keys into the cache of a state.
  void store(State &state);

  const PreconditionerKey &active() const { return keys_.active; }
  const PreconditionerKey &pending() const { return keys_.pending; }
  void set(PreconditionerKeys keys);
  void set_pending(PreconditionerKey key) { set({keys_.active, std::move(key)}); }
  void drop() { set({}); }
  void count_active_use() { ++keys_.active.age; }
  uint32_t count_pending_part() { return ++keys_.pending.age; }

 private:
  PreconditionerKeys keys_;
  SolverCache packed_;     // holds keys_, but for their ages, where `is_packed_`
  bool is_packed_ = true;  // of the empty cache
  // two states, packed_ and one more
  std::array<CowVector<double>, 4> buffers_;
};

// Returns the first buffer that is not shared, or else empties one: states and factors that hold
// the others keep their memory.
template <typename Item, size_t count>
CowVector<Item> &free_buffer(std::array<CowVector<Item>, count> &buffers) {
  for (CowVector<Item> &buffer : buffers) {
    if (buffer.is_alone()) return buffer;
  }
  return buffers.front() = {};
}

}  // namespace mvs::core
