// Chordae: tension-only cables, straight or branching at free nodes.
#pragma once

#include <vector>

#include "model/model.h"
#include "physics/blocks.h"
#include "physics/system.h"

namespace mvs {

class ChordTerm {
 public:
  explicit ChordTerm(const Model &model);

  bool empty() const { return cables_.empty(); }
  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  void hessian(const std::vector<Vec3> &x, Curvature curvature, System &system) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  struct Cable {
    uint32_t a, b;
    double length;     // L0, m
    double stiffness;  // E A, N
  };
  std::vector<Cable> cables_;
};

}  // namespace mvs
