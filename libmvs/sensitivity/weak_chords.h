// Chordae about to become slack or taut, and the one-sided derivatives there.
//
// In a direction of the parameters the elongations u and extra tensions t of the m weak chordae
// satisfy u = u0 - S t with t_i = k_i max(u_i, 0) where the tangent has chord i slack, and
// t_i = k_i max(-u_i, 0) where it has it taut: a complementarity problem, the optimality condition
// of a quadratic program over the weak chordae (Pirnay, Lopez-Negrete & Biegler, Math. Prog. Comp.
// 4, 2012, equation 14, for the same at weakly active constraints). The factor of the tangent
// stays.
#pragma once

#include "sensitivity/tangent.h"

namespace mvs::core {

struct WeakChord {
  uint32_t chord;
  Vec3 along;        // unit, from a to b
  double stiffness;  // N/m, once taut
  bool is_taut;      // in the tangent
};

// Chordae whose length is within `slack`, m, of their rest length.
std::vector<WeakChord> find_weak_chords(const Model &model, const std::vector<Vec3> &x,
                                        double slack);

// Solves for the extra tensions t per change of the parameter, with the rates of elongation u0 of
// the tangent and the flexibility S (row-major). Enumerates the states of up to max_weak_chords
// chordae; empty if none of them is consistent.
inline constexpr size_t max_weak_chords = 10;
std::vector<double> extra_tensions(const std::vector<WeakChord> &chords,
                                   const std::vector<double> &flexibility,
                                   const std::vector<double> &rates);

}  // namespace mvs::core
