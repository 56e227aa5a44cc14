// The variants of a valve: models with one mesh, which share the work that depends on it alone.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "model/valve.h"

namespace mvs::core {

struct Model;
struct FamilyLevel;  // anatomy/family_level.h

// Whether a description, complete or not, has the mesh of a model bit for bit: nodes, triangles
// with leaflet, scallop and fibre (if given), annulus, heads, ends and kinds of the chordae. Rest
// lengths, stiffnesses, thickness, laws, names and all constants may differ.
bool has_mesh_of(const Valve &valve, const Model &model);

// Shared by all models of a family, from any thread. Holds immutable results only, and no result
// depends on the others.
class MeshFamily {
 public:
  void add_model() { models_.fetch_add(1, std::memory_order_relaxed); }
  // Whether it is worth keeping results: a valve without variants keeps none.
  bool has_variants() const { return models_.load(std::memory_order_relaxed) > 1; }

  std::vector<std::shared_ptr<const FamilyLevel>> levels() const;
  // Keeps a coarser mesh that none of the `known` first levels serves, unless another thread has
  // kept one since, which may be the same, or there are as many as a family may have.
  void keep(std::shared_ptr<const FamilyLevel> level, size_t known);

 private:
  std::atomic<uint32_t> models_{0};
  mutable std::mutex mutex_;  // protects the list; its items are immutable
  std::vector<std::shared_ptr<const FamilyLevel>> levels_;
};

}  // namespace mvs::core
