// Masses of dynamic relaxation: with them a time step of 1 is stable (Underwood, Dynamic
// relaxation, in: Belytschko, Hughes, Computational Methods for Transient Analysis, 1983).
#pragma once

#include <vector>

#include "energy/total_energy.h"

namespace bench {

// Central differences with a step of 1 are stable where no eigenvalue of M^-1 K is above 4. By
// Gershgorin's theorem for 3x3 blocks none is, if the mass of a node is a quarter of the sum of the
// norms of the blocks in its row of K.
class FictitiousMasses {
 public:
  struct Options {
    double safety;  // multiple of that mass
    // Share by which every length grows before K is evaluated: springs and chordae that are about
    // to pull tight count as tight.
    double margin;
    double kept;  // least share of the mass before
  };
  FictitiousMasses(const mvs::core::Model &model, const Options &options);

  // Renews the masses at x, with the contact pairs there (penalty contact).
  void renew(const std::vector<mvs::core::Vec3> &x, const mvs::core::ContactTerm &contact);
  double operator[](size_t node) const { return mass_[node]; }

 private:
  void add_tissue(const std::vector<mvs::core::Vec3> &x);
  void add_contact(const mvs::core::ContactTerm &contact);

  const mvs::core::Model *model_;
  Options options_;
  mvs::core::SpringTerm spring_;
  mvs::core::MembraneTerm membrane_;
  mvs::core::BendingTerm bending_;
  mvs::core::CableTerm chord_;
  size_t first_membrane_, first_bending_, first_chord_;  // pairs of each; springs begin at 0
  mvs::core::HessianAssembler system_;
  std::vector<mvs::core::Vec3> stretched_;
  std::vector<double> mass_, row_, sorted_;
};

}  // namespace bench
