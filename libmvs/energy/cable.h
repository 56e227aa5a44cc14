// Chordae as tension-only cables: energy, gradient and Hessian. They may branch at free nodes.
#pragma once

#include <vector>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "model/model.h"

namespace mvs::core {

class CableTerm {
 public:
  explicit CableTerm(const Model &model);

  bool empty() const { return valve_->chords.empty(); }
  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  void hessian(const std::vector<Vec3> &x, Curvature curvature, HessianAssembler &system) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  const Valve *valve_;
};

}  // namespace mvs::core
