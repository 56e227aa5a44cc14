// Sums the terms in a fixed order, so that the bits of energies and forces do not depend on use.
#include "energy/total_energy.h"

namespace mvs::core {
namespace {

// Microseconds for an element of the sheet, about, of all its terms.
constexpr double energy_us = 0.03, gradient_us = 0.05, hessian_us = 0.15;

}  // namespace

TotalEnergy::TotalEnergy(const Model &model, ContactLaw law)
    : model_(&model),
      spring_(model),
      membrane_(model),
      bending_(model),
      chord_(model),
      pressure_(model),
      broad_phase_(model),
      contact_(model, law),
      instrument_(model) {
  spring_.add_pairs(pairs_);
  first_[of_membrane] = pairs_.size();
  membrane_.add_pairs(pairs_);
  first_[of_bending] = pairs_.size();
  bending_.add_pairs(pairs_);
  first_[of_chord] = pairs_.size();
  chord_.add_pairs(pairs_);
  first_[of_pressure] = pairs_.size();
  pressure_.add_pairs(pairs_);
}

void TotalEnergy::set_tools(const std::vector<Tool> &tools) {
  uint32_t points = 0;
  for (const Tool &tool : tools) points += tool.points();
  const uint32_t first = static_cast<uint32_t>(model_->node_count()) - points;
  grasp_.set_tools(tools, first);
  instrument_.bodies().set_tools(tools, first);
}

void TotalEnergy::prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack,
                          Profile &profile) {
  const PhaseTimer timer(profile, MVS_PHASE_BROAD);
  ++profile.broad_phases;
  broad_phase_.build(x, to, slack);
  instrument_.bodies().prepare(x, to, slack);
}

void TotalEnergy::limit_step(const std::vector<Vec3> &x, double slack, std::vector<Vec3> &dx,
                             Profile &profile) {
  const PhaseTimer timer(profile, MVS_PHASE_BROAD);
  profile.broad_phases +=
      step_limiter_.limit(*model_, x, slack, broad_phase_, dx, &instrument_.bodies());
}

uint32_t TotalEnergy::skipped() const {
  uint32_t skipped = 0;
  if (spring_.empty()) skipped |= MVS_SKIPPED_SPRINGS;
  if (membrane_.empty()) skipped |= MVS_SKIPPED_MEMBRANE;
  if (bending_.empty()) skipped |= MVS_SKIPPED_BENDING;
  if (chord_.empty()) skipped |= MVS_SKIPPED_CHORDAE;
  if (pressure_.empty()) skipped |= MVS_SKIPPED_PRESSURE;
  if (!was_near_ && broad_phase_.empty()) skipped |= MVS_SKIPPED_CONTACT;
  return skipped;
}

void TotalEnergy::collect(const std::vector<Vec3> &x) {
  was_near_ = was_near_ || !broad_phase_.empty();
  contact_.collect(x, broad_phase_, shared_.workers());
  instrument_.collect(x);
}

double TotalEnergy::energy(const std::vector<Vec3> &x) {
  collect(x);
  if (shared_.pay(*this, energy_us)) return shared_.energy(*this, x);
  return spring_.energy(x) + membrane_.energy(x) + bending_.energy(x) + chord_.energy(x) +
         instrument_.energy(x) + contact_.energy() + pressure_.energy(x) + grasp_.energy(x);
}

double TotalEnergy::gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g, Profile &profile) {
  pressure_.freeze(x);
  const double sheet = sheet_gradient(x, g, profile);
  return sheet + add_hands(x, g);
}

double TotalEnergy::sheet_gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g,
                                   Profile &profile) {
  {
    const PhaseTimer timer(profile, MVS_PHASE_NARROW);
    collect(x);
  }
  ++profile.passes;
  const PhaseTimer timer(profile, MVS_PHASE_TERMS);
  if (shared_.pay(*this, gradient_us)) return shared_.gradient(*this, x, g, elastic_);
  g.assign(x.size(), Vec3::Zero());
  elastic_ = spring_.gradient(x, g);
  elastic_ += membrane_.gradient(x, g);
  elastic_ += bending_.gradient(x, g);
  elastic_ += chord_.gradient(x, g);
  elastic_ += instrument_.gradient(x, g);
  elastic_ += contact_.gradient(g);
  return elastic_ + pressure_.gradient(x, g);
}

double TotalEnergy::freeze(const std::vector<Vec3> &x) {
  pressure_.freeze(x);
  return elastic_ + pressure_.energy(x);
}

bool TotalEnergy::fill(const std::vector<Vec3> &x, Curvature curvature,
                       HessianAssembler &assembler) {
  if (shared_.pay(*this, hessian_us)) return shared_.fill(*this, x, curvature, assembler);
  assembler.clear();
  // contact first: the pattern may lack its blocks, and the rest would be computed in vain
  if (!contact_.hessian(x, curvature, assembler)) return false;
  if (!instrument_.hessian(x, curvature, assembler)) return false;
  fill_sheet(x, curvature, assembler);
  grasp_.hessian(x, assembler);
  return true;
}

void TotalEnergy::set_pattern(HessianAssembler &assembler) {
  wanted_.clear();
  contact_.add_pairs(wanted_);
  instrument_.add_pairs(wanted_);
  assembler.set_pattern(*model_, pairs_, wanted_);
}

bool TotalEnergy::hessian(const std::vector<Vec3> &x, Curvature curvature,
                          HessianAssembler &assembler, Profile &profile) {
  ++profile.passes;
  if (!assembler.row_of.empty()) {
    const PhaseTimer timer(profile, MVS_PHASE_ASSEMBLY);
    if (fill(x, curvature, assembler)) return false;
  }
  // the pattern lacks blocks of contact: build a new one from the present contact pairs
  {
    const PhaseTimer timer(profile, MVS_PHASE_ORDERING);
    ++profile.orderings;
    set_pattern(assembler);
  }
  const PhaseTimer timer(profile, MVS_PHASE_ASSEMBLY);
  fill(x, curvature, assembler);
  return true;
}

}  // namespace mvs::core
