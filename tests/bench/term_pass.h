// Energy, gradient and Hessian of one term: by one thread, and by parts of the nodes as in
// SharedTerms.
#pragma once

#include <vector>

#include "base/workers.h"
#include "energy/follower_pressure.h"
#include "energy/hessian_assembler.h"
#include "energy/node_parts.h"

namespace bench {

using mvs::core::FollowerPressureTerm;
using mvs::core::Vec3;
using Positions = std::vector<Vec3>;

template <typename Term>
double pass(Term &term, const Positions &x, mvs::core::HessianAssembler &system,
            std::vector<Vec3> &g) {
  const double energy = term.energy(x) + term.gradient(x, g);
  term.hessian(x, mvs::core::Curvature::projected, system);
  return energy;
}

inline double pass(FollowerPressureTerm &term, const Positions &x,
                   mvs::core::HessianAssembler &system, std::vector<Vec3> &g) {
  term.freeze(x);
  const double energy = term.energy(x) + term.gradient(x, g);
  term.hessian(x, system);
  return energy;
}

// Part `number` of `count`.
struct PartOf {
  uint32_t number, count;

  uint32_t begin(size_t size) const { return mvs::core::begin_of_part(number, count, size); }
  uint32_t end(size_t size) const { return mvs::core::begin_of_part(number + 1, count, size); }
};

template <typename Term>
void pass_of_part(Term &term, const Positions &x, mvs::core::HessianPart &system,
                  mvs::core::PartGradient &to, const PartOf &part) {
  term.energies(x, part.begin(term.size()), part.end(term.size()), to.energy);
  term.add_gradient(x, to);
  term.hessian(x, mvs::core::Curvature::projected, system);
}

inline void pass_of_part(FollowerPressureTerm &term, const Positions &x,
                         mvs::core::HessianPart &system, mvs::core::PartGradient &to,
                         const PartOf &part) {
  if (part.number == 0) term.freeze(x);
  term.volumes(x, part.begin(term.size()), part.end(term.size()), to.energy);
  term.add_gradient(x, to);
  term.hessian(x, system);
}

}  // namespace bench
