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
  // To a WholeGradient or a PartGradient.
  template <typename Gradient>
  void add_gradient(const std::vector<Vec3> &x, Gradient &to) const;
  // Adds to a HessianAssembler or a HessianPart.
  template <typename Assembler>
  void hessian(const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler) const;
  // Elements, and the energies of elements first .. last.
  size_t size() const { return valve_->chords.size(); }
  void energies(const std::vector<Vec3> &x, size_t first, size_t last, double *to) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  size_t index_of(const Chord &c) const { return static_cast<size_t>(&c - valve_->chords.data()); }

  const Valve *valve_;
};

}  // namespace mvs::core
