// Division of the nodes among threads: each thread computes the elements that touch a node of its
// part, in their order, and adds to its own nodes only. So each sum has the order, and the bits, of
// a single thread; the elements along the cuts are computed by two.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// The nodes of one part.
class NodePart {
 public:
  NodePart(const std::vector<uint16_t> &part_of, uint32_t part)
      : part_of_(part_of.data()), part_(static_cast<uint16_t>(part)) {}
  bool has(uint32_t node) const { return part_of_[node] == part_; }
  template <typename Nodes>
  bool has_any(const Nodes &nodes) const {
    for (const uint32_t i : nodes) {
      if (has(i)) return true;
    }
    return false;
  }

 private:
  const uint16_t *part_of_;
  uint16_t part_;
};

class NodeParts {
 public:
  // Recursive coordinate bisection of the rest shape into parts of equally many nodes, whose cuts
  // are short. Does nothing if the division is that of the last call.
  void divide(const Model &model, uint32_t parts);

  uint32_t count() const { return count_; }
  NodePart part(uint32_t k) const { return {part_of_, k}; }

 private:
  void bisect(const std::vector<Vec3> &x, uint32_t *begin, uint32_t *end, uint32_t first,
              uint32_t last);

  std::vector<uint16_t> part_of_;
  std::vector<uint32_t> order_;
  uint32_t count_ = 0;
};

// Where a term adds its gradient: at all nodes, with the energy as a sum in the order of elements.
struct WholeGradient {
  std::vector<Vec3> &g;
  double energy = 0;

  template <typename Nodes>
  static constexpr bool takes(const Nodes &) {
    return true;
  }
  void add_energy(size_t, uint32_t, double e) { energy += e; }
  // A batch of elements has a sum of its own.
  WholeGradient begin_batch() const { return {g}; }
  void end_batch(const WholeGradient &batch) { energy += batch.energy; }
  void add(uint32_t i, const Vec3 &f) { g[i] += f; }
  void subtract(uint32_t i, const Vec3 &f) { g[i] -= f; }
};

// The same at the nodes of one part, with the energy of each element whose first node it has.
struct PartGradient {
  std::vector<Vec3> &g;
  NodePart part;
  double *energy;

  template <typename Nodes>
  bool takes(const Nodes &nodes) const {
    return part.has_any(nodes);
  }
  void add_energy(size_t element, uint32_t node, double e) {
    if (part.has(node)) energy[element] = e;
  }
  PartGradient begin_batch() const { return *this; }
  void end_batch(const PartGradient &) {}
  void add(uint32_t i, const Vec3 &f) {
    if (part.has(i)) g[i] += f;
  }
  void subtract(uint32_t i, const Vec3 &f) {
    if (part.has(i)) g[i] -= f;
  }
};

}  // namespace mvs::core
