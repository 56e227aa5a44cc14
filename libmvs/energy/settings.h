// Tuning constants of assembling and ordering the Hessian, and of the rod. solve/settings.h has
// those of the solvers.
#pragma once

#include <cstddef>

namespace mvs::core::settings {

namespace assembly {

// Blocks, as a multiple of those that are needed, that a pattern may hold. A pattern keeps the
// blocks of earlier contact up to this size, so that it seldom changes.
inline constexpr double max_pattern_growth = 1.25;

// Rows from which nested dissection is tried beside minimum degree. It makes the factorisations of
// a closure cheaper by 3 % with 1,700 vertices, 7 % with 3,400, 25 % with 6,800 and 31 % with
// 27,000.
inline constexpr size_t min_dissection_rows = 1000;

}  // namespace assembly

namespace instrument {

// N/m, axial stiffness of a rod: 5 N on its ends shorten it by a quarter of a millimetre.
inline constexpr double rod_stiffness = 2e4;
// N/m, of each of the six edges of the frame of a convex tool, as for a rod: 5 N stretch it by
// about a hundredth of its arm. At 1e5 a live step took 1.7 times as long as that of a ball instead
// of 1.46 (bench_step --tool convex), and the valve did not come to rest beside a still hand.
inline constexpr double frame_stiffness = 2e4;
// Share of the force limit of a hand in the strength of each short-range barrier of its tool: one
// pair bears the whole force at 0.12 of its range, 24 um in a default valve. With the strength of
// the sheet's own barriers alone a ball pressed with 5 N was 1 um from the tissue, where steps in
// time that would turn a triangle around the ball end after 1 um: ball and valve stood still.
inline constexpr double force_share = 0.1;
// Share by which the distance of a convex body depends on the place on a triangle or chord, so that
// it has no kinks (geometry/smooth_distance.h). 60 of 60 settles of tests/solve/convex_settles.cpp
// converge at 0.5 and at 1; lower values turn facets harder, higher ones change the gap more.
inline constexpr double smoothing = 0.5;

}  // namespace instrument

}  // namespace mvs::core::settings
