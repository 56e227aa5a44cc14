// Total energy of a valve: the sum of all terms of a model, with gradient, Hessian, broad phase and
// step limiter. Every solver runs on it.
#pragma once

#include <vector>

#include "collision/broad_phase.h"
#include "collision/step_limiter.h"
#include "energy/bending.h"
#include "energy/cable.h"
#include "energy/contact.h"
#include "energy/follower_pressure.h"
#include "energy/grasp.h"
#include "energy/instrument.h"
#include "energy/membrane.h"
#include "energy/profile.h"
#include "energy/shared_terms.h"
#include "energy/spring.h"

namespace mvs::core {

class TotalEnergy {
 public:
  explicit TotalEnergy(const Model &model, ContactLaw law = ContactLaw::barrier);

  // Threads that may share the work; they outlive this. Null, the default: none. No bit depends on
  // them.
  void use_workers(Workers *workers) {
    shared_.use_workers(workers);
    broad_phase_.use_workers(workers);
  }

  void set_pressure(double pressure) { pressure_.set_pressure(pressure); }
  // The points of instruments are the last nodes (solve/tools/tool_points.h).
  void set_tools(const std::vector<Tool> &tools);

  // See BroadPhase.
  void use_verlet_list(bool use) { broad_phase_.use_verlet_list(use); }
  void use_verlet_list_at_once() { broad_phase_.use_verlet_list_at_once(); }
  // Builds the broad phase for nodes that stay within `slack`, m, of their paths from x to `to`.
  void prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
               Profile &profile);
  // Shortens a step dx from x so that nothing passes through (conservative continuous collision
  // detection). The broad phase then holds at x, at x + dx, and between.
  void limit_step(const std::vector<Vec3> &x, double slack, std::vector<Vec3> &dx,
                  Profile &profile);
  bool prepared_for(const std::vector<Vec3> &x) const {
    return instrument_.bodies().is_prepared() && broad_phase_.valid_for(x);
  }

  // Resets the record of contact for skipped().
  void begin_call() { was_near_ = false; }
  // MVS_SKIPPED_* of the terms that no pass since begin_call() has computed.
  uint32_t skipped() const;

  // The energy at x, comparable between calls of gradient(); x must be prepared for.
  double energy(const std::vector<Vec3> &x);
  // Sets g = dE/dx and returns the energy; x must be prepared for.
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g, Profile &profile);

  // The same in parts, for a step that accepts a trial. Gradient and energy without the springs of
  // hands; the energy is comparable with that of the last freeze().
  double sheet_gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g, Profile &profile);
  // Freezes the follower load at the x of the last sheet_gradient(); returns the energy there.
  double freeze(const std::vector<Vec3> &x);
  // The springs of hands: the only terms that change when only hands move.
  double hands_energy(const std::vector<Vec3> &x) const { return grasp_.energy(x); }
  double add_hands(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
    return grasp_.gradient(x, g);
  }
  // Assembles the Hessian at the x of the last gradient(). Returns true if its pattern is new.
  bool hessian(const std::vector<Vec3> &x, Curvature curvature, HessianAssembler &assembler,
               Profile &profile);

  // Adds the skew part that the Hessian leaves out: see FollowerPressureTerm::add_skew.
  void add_skew(const std::vector<Vec3> &x, const std::vector<Vec3> &v,
                std::vector<Vec3> &y) const {
    pressure_.add_skew(x, v, y);
  }

  // Sets the pattern that the Hessian at the x of the last gradient() needs.
  void set_pattern(HessianAssembler &assembler);
  // Pairs of nodes that terms with a fixed pattern couple.
  const std::vector<Edge> &pairs() const { return pairs_; }
  const BroadPhase &broad_phase() const { return broad_phase_; }
  const ContactTerm &contact() const { return contact_; }
  const SpringTerm &springs() const { return spring_; }
  InstrumentTerm &instrument() { return instrument_; }

 private:
  friend class SharedTerms;
  void collect(const std::vector<Vec3> &x);
  bool fill(const std::vector<Vec3> &x, Curvature curvature, HessianAssembler &assembler);
  template <typename Assembler>
  void fill_sheet(const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler) const;

  const Model *model_;
  SpringTerm spring_;
  MembraneTerm membrane_;
  BendingTerm bending_;
  CableTerm chord_;
  FollowerPressureTerm pressure_;
  BroadPhase broad_phase_;
  StepLimiter step_limiter_;
  ContactTerm contact_;
  GraspTerm grasp_;
  InstrumentTerm instrument_;
  bool was_near_ = false;    // the broad phase had pairs since begin_call()
  double elastic_ = 0;       // J, of the last sheet_gradient(), without that of the pressure
  std::vector<Edge> pairs_;  // of the terms with a fixed pattern
  enum Pairs : size_t { of_membrane, of_bending, of_chord, of_pressure };
  std::array<size_t, 4> first_{};  // index of the first pair of each; springs begin at 0
  std::vector<Edge> wanted_;       // pairs of contact, while a pattern is built
  SharedTerms shared_;
};

template <typename Assembler>
void TotalEnergy::fill_sheet(const std::vector<Vec3> &x, Curvature curvature,
                             Assembler &assembler) const {
  assembler.begin_term(0);
  spring_.hessian(x, curvature, assembler);
  assembler.begin_term(first_[of_membrane]);
  membrane_.hessian(x, curvature, assembler);
  assembler.begin_term(first_[of_bending]);
  bending_.hessian(x, curvature, assembler);
  assembler.begin_term(first_[of_chord]);
  chord_.hessian(x, curvature, assembler);
  assembler.begin_term(first_[of_pressure]);
  pressure_.hessian(x, assembler);
}

}  // namespace mvs::core
