// Nested iteration over a mesh hierarchy: settles a large valve on a coarser mesh of itself first,
// and that one on a coarser one still, and starts on the fine mesh from the shape that the coarse
// mesh closed to.
//
// The leaflets take their places in long waves, which a coarse mesh resolves; shorter folds form on
// the fine mesh at the end. The path differs from that of the fine mesh alone, so a valve that can
// fold in several ways may close to another of its shapes (libmvs/ensemble). A valve near rest, as
// after most operations, starts from its own shape, which is better than that of a coarse mesh.
#pragma once

#include "solve/settling.h"

namespace mvs::core {

// Settles as Solver::settle does. Uses coarser meshes with Newton's method on at least
// settings::mesh_hierarchy::min_vertices vertices of the sheet, if the valve is far from rest and
// has no tools, and if the shape from the coarse mesh does not intersect itself. The count of
// iterations is that of the mesh itself; factorisations, passes and times are those of all levels.
SolveStats settle_with_mesh_hierarchy(Solver &solver, const Model &model, State &state,
                                      const SolveOptions &options, const Progress &progress);
// Begins the same settle, to be advanced by the caller, as Solver::begin_settle.
std::unique_ptr<Settling> begin_settle_with_mesh_hierarchy(Solver &solver, const Model &model,
                                                           const State &state,
                                                           const SolveOptions &options,
                                                           const Progress &progress);

}  // namespace mvs::core
