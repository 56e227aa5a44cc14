// Nested iteration over a mesh hierarchy: settles a large valve on a coarser mesh of itself first,
// and that one on a coarser one still, and starts on the fine mesh from the shape that the coarse
// mesh closed to.
//
// The leaflets take their places in long waves, which a coarse mesh resolves; shorter folds form on
// the fine mesh at the end. The path differs from that of the fine mesh alone, so a valve that can
// fold in several ways may close to another of its shapes (libmvs/ensemble). Where tissue has
// the law of May-Newman and Yin or of Fung the levels have the bilinear membrane, and one of them
// the mesh of the valve. A valve near rest, as after most operations, starts from its own shape,
// which is better than that of a coarse mesh.
#pragma once

#include <memory>

#include "anatomy/coarsen.h"
#include "solve/settling.h"

namespace mvs::core {

// The coarser meshes of the models settled last, with their maps: a model that is settled again
// from far away does not make them anew.
class CoarseLevels {
 public:
  // See coarsen_in_family().
  std::shared_ptr<const Coarsened> coarsened(const Model &fine, size_t vertices);
  // The same valve with a bilinear membrane in place of exponential tissue.
  ModelPtr surrogate(const Model &fine);

 private:
  struct Kept {
    uint64_t serial;  // of the finer model
    size_t vertices;  // asked for
    std::shared_ptr<const Coarsened> made;
  };
  std::vector<Kept> kept_;  // the last one made last
  ModelPtr surrogate_;
  uint64_t surrogate_of_ = 0;  // serial of its valve
};

// Settles as Solver::settle does. Uses coarser meshes with Newton's method on as many
// vertices of the sheet as settings::mesh_hierarchy asks for, if the valve is far from rest and
// has no tools, and if the shape from the coarse mesh does not intersect itself or can be untangled
// (untangle.h). The count of iterations is that of the mesh itself; factorisations, passes and
// times are those of all levels.
SolveStats settle_with_mesh_hierarchy(Solver &solver, const Model &model, State &state,
                                      const SolveOptions &options, const Progress &progress);
// Begins the same settle, to be advanced by the caller, as Solver::begin_settle.
std::unique_ptr<Settling> begin_settle_with_mesh_hierarchy(Solver &solver, const Model &model,
                                                           const State &state,
                                                           const SolveOptions &options,
                                                           const Progress &progress);

}  // namespace mvs::core
