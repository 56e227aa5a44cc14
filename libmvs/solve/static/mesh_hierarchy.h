// Static closure from coarse to fine: a large valve is first closed on a coarser mesh of itself,
// where that is cheap, and its shape carried to the fine one, which is then nearly at rest.
//
// What decides where the leaflets go happens on the way, and most of it is long waves that a coarse
// mesh has too; folds finer than that form on the fine mesh at the end. The way is another one than
// on the fine mesh alone, and so a valve that can fold in several ways may close to another one of
// its shapes (libmvs/ensemble). The start of a valve near rest, as after most operations, is better
// than any coarse mesh's, and is left alone.
#pragma once

#include "solve/solver.h"

namespace mvs::core {

// Settles as Solver::settle does, over coarser meshes where that pays: with Newton's method, on at
// least cascade_vertices of the sheet, if the valve is far from rest, without tools on it, and if
// what comes from the coarse mesh crosses nothing. The count of iterations is that of the mesh
// itself; factorisations, passes and times are those of all.
SolveStats settle_with_mesh_hierarchy(Solver &solver, const Model &model, State &state,
                                      const SolveOptions &options, const Progress &progress);

inline constexpr size_t hierarchy_vertices = 1200;

}  // namespace mvs::core
