// Rest under dead loads, which the library does not support: the energy terms of the library plus a
// linear term of the test, brought to rest by a plain damped Newton.
#pragma once

#include "energy/bending.h"
#include "energy/cable.h"
#include "energy/membrane.h"
#include "energy/spring.h"
#include "tests/solve/bench.h"

namespace mvs::core::verification {

using mvs::core::test::Positions;

class Balance {
 public:
  // Terms of `model`, whose free nodes may be held here: `held` are their positions.
  Balance(const Model &model, const std::vector<uint32_t> &held);

  // Positions at which no free node has more than `tolerance` N; throws if Newton does not reach
  // such positions. Energy - sum of load . x falls from step to step.
  Positions rest(Positions start, const Positions &load, double tolerance) const;

  // dE/dx of all terms, also on held nodes: their reactions.
  double gradient(const Positions &x, Positions &g) const;

 private:
  struct Newton;

  Model held_;  // for the rows of the system
  SpringTerm spring_;
  MembraneTerm membrane_;
  BendingTerm bending_;
  CableTerm chord_;
};

}  // namespace mvs::core::verification
