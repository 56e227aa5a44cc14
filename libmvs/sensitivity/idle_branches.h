// Branch points of chordae that bear nothing. A settle leaves them anywhere in the space that their
// slack chordae allow, often at its border, where a chord has its rest length: a tangent there
// would take the chord for one that is about to become taut.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Moves branch points without a tension above `tolerance`, N, to where all their chordae are
// shorter than their rest length by `margin`, m, by relaxation of the excess lengths
// (Gauss-Seidel). Points for which it finds no such place stay: their chordae are just taut.
// Returns whether one moved.
bool slacken_idle_branches(const Model &model, double tolerance, double margin,
                           std::vector<Vec3> &x);

}  // namespace mvs::core
