// Every tuning constant of a closure over coarser meshes, as in solve/settings.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvs::core::settings {

// Nested iteration over coarser meshes.
namespace mesh_hierarchy {

// A quarter of the vertices doubles the edge length, for an eighth of the work or less.
inline constexpr size_t coarsening = 4;
struct Extent {
  size_t min_vertices;         // of the sheet: below it the mesh is settled itself
  size_t min_coarse_vertices;  // of the coarsest mesh
  double coarse_residual;      // at which a coarse mesh is left, rest forces
};
// Springs and bilinear membrane. The default valve of 425, 700, 1,000 and 1,700 vertices takes
// 0.40, 0.27, 0.33 and 0.38 of the time that it takes with 1,200, 425 and 2 (bilinear), because a
// coarse valve finds its fold in a few cheap iterations. From a coarse residual of 1 or 2 the
// default valve of 1,700 vertices takes 28 and 49 iterations, not 15. Meshes of 300 vertices with
// 60 coarse ones take half to twice the time.
inline constexpr Extent bilinear = {400, 110, 0.25};
// Tissue with another law, which is exponential or neo-Hookean: on 425 vertices coarse meshes
// cost 1.3 to 2.5 times the time.
inline constexpr Extent other_laws = {1200, 425, 2};
inline constexpr uint32_t max_coarse_iterations = 200;
// Rest forces at which the bilinear surrogate of exponential tissue is left. Nine valves of 1,300
// to 1,900 vertices (other annulus, thickness, slack, coaptation depth, the founding shape;
// measured once, by no command of the repository) under May-Newman and Yin's law and Fung's: 2,453
// iterations on the mesh itself for 3,290, 0.80 of the CPU time (loaded machine), 13 of 18 at a
// lower energy, two at one 13 and 21 % higher. The valve with deep coaptation under May-Newman and
// Yin's law took 1.6 times as long. A neo-Hookean surrogate took more. Prot's law, five valves: 0.5
// of the time, but four of them ended at energies that are 12 to 51 % higher.
inline constexpr double surrogate_residual = 1;
// Rest forces at the start above which a valve of any size has the surrogate first, although few
// of its nodes may be far from rest, and those at which it is left: before the rest of the valve
// follows the other law. Valves of 425 vertices under May-Newman and Yin's law and Fung's (measured
// once, by no command of the repository: 374 settles of 96 random valves, each after a random
// operation; sums over those that differ): 13,911 iterations for 16,927, CPU time 0.97; clips 0.70
// of the iterations, resections, then made on the closed valve, 0.63. Left at 1, transferred
// chordae took up to 875 iterations for 50, and one clip did not come to rest.
inline constexpr double overstretched = 1000, overstretched_residual = 30;
// Share of the reported progress that the coarse meshes take: about their share of the time.
inline constexpr double coarse_progress = 0.25;

}  // namespace mesh_hierarchy

// Crossings after interpolation from a coarser mesh.
namespace untangle {

inline constexpr size_t max_crossings = 200;  // of triangles: with more the finer mesh starts open
inline constexpr double increment = 0.05;     // of the contact thickness, in a round
inline constexpr uint32_t rounds = 20;

}  // namespace untangle

}  // namespace mvs::core::settings
