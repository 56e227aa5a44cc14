// Fixture: contact energy alone.
#pragma once

#include "energy/contact.h"
#include "tests/solve/bench.h"

namespace mvs::core::test {

// Contact alone, as functions of the positions near `around`.
class Touch {
 public:
  Touch(const Model &model, const Positions &around, double reach,
        ContactLaw law = ContactLaw::barrier)
      : model_(&model), broad_phase_(model), term_(model, law) {
    broad_phase_.build(around, around, reach);
  }
  double energy(const Positions &x) {
    term_.collect(x, broad_phase_);
    return term_.energy();
  }
  Positions gradient(const Positions &x) {
    term_.collect(x, broad_phase_);
    Positions g(x.size(), Vec3::Zero());
    term_.gradient(g);
    return g;
  }
  Eigen::MatrixXd hessian(const Positions &x, Curvature curvature) {
    term_.collect(x, broad_phase_);
    HessianAssembler system;
    std::vector<Edge> pairs;
    term_.add_pairs(pairs);
    system.set_pattern(*model_, pairs);
    system.clear();
    CHECK(term_.hessian(x, curvature, system));
    return dense(system);
  }
  const std::vector<ContactPair> &contact_pairs() const { return term_.contact_pairs(); }

 private:
  const Model *model_;
  BroadPhase broad_phase_;
  ContactTerm term_;
};

}  // namespace mvs::core::test
