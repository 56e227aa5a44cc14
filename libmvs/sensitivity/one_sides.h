// One-sided derivatives where chordae are about to become slack or taut: the tensions that they add
// on each side (weak_chords), and what these do to the quantities.
#pragma once

#include "sensitivity/linear_response.h"
#include "sensitivity/weak_chords.h"

namespace mvs::core {

class OneSides {
 public:
  // The elongations of the weak chordae are gradients of `response` from `first` on, and the
  // quantities are those before. Keeps references.
  OneSides(const SensitivityRequest &request, const LinearResponse &response,
           const std::vector<WeakChord> &weak, EquilibriumTangent &tangent);

  // What is added to the derivative by parameter p on each side; a row a quantity, empty on a side
  // where no state of the chordae is consistent. `switches`: whether a chord changes its state.
  struct Sides {
    std::vector<double> above, below;
    bool switches = false;
  };
  Sides sides_of(size_t p) const;

 private:
  std::vector<double> rates_of(size_t p) const;
  std::vector<double> changes(size_t p, const std::vector<double> &tensions) const;
  double change_of(size_t q, size_t p, const std::vector<double> &tensions) const;

  const SensitivityRequest &request_;
  const LinearResponse &response_;
  const std::vector<WeakChord> &weak_;
  std::vector<NodeField> motion_;    // K^-1 of a unit tension of each weak chord
  std::vector<double> flexibility_;  // row-major
};

// The gradient of the elongation of a weak chord.
NodeField elongation_gradient(const Model &model, const WeakChord &weak);

}  // namespace mvs::core
