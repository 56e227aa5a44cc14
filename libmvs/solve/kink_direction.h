// A direction that leads downhill at a kink of the energy, as the contact of a convex tool has
// where one of its facets or edges lies parallel to tissue (energy/convex_contact.h).
//
// On both sides of a kink the force is another one. A step along the force of one side leads uphill
// on the other, however short it is, though the energy falls along the kink. Of all means of the
// forces found so far, the one whose solution is shortest in the norm of the step matrix pushes
// against none of them (aggregate subgradients: Kiwiel, Methods of Descent for Nondifferentiable
// Optimization, 1985).
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

class KinkDirection {
 public:
  // At most so many rows follow.
  void reserve(size_t rows);
  // Begins with a right-hand side of the step's linear system and its solution.
  void begin(const std::vector<Vec3> &force, const std::vector<Vec3> &rows);
  // Takes a right-hand side on the other side of a kink, and its solution.
  void add(const std::vector<Vec3> &force, const std::vector<Vec3> &rows);
  // m: the step of the mean force.
  const std::vector<Vec3> &rows() const { return rows_; }

 private:
  std::vector<Vec3> force_, rows_;
};

}  // namespace mvs::core
