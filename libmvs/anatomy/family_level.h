// Coarser levels of the variants of a valve: one coarsening of the mesh serves all of them.
#pragma once

#include "anatomy/coarsen.h"

namespace mvs::core {

// A coarser level of one variant, with what decides whether it serves another.
struct FamilyLevel {
  size_t vertices;  // asked for
  // of the fine triangles
  CowVector<double> thickness;
  CowVector<Vec3> fibre;
  std::vector<ChordStep> steps;
  std::shared_ptr<const Coarsened> made;
};

// Returns the level of coarsen(model, vertices), bit for bit. If another variant has been coarsened
// to as many vertices, its mesh and map serve this one, and only chordae, constants and names are
// set anew. They do not serve if thickness or fibres differ, or if chordae that were merged there
// must stay apart here, or the reverse. May be called from any thread.
std::shared_ptr<const Coarsened> coarsen_in_family(const Model &model, size_t vertices);

}  // namespace mvs::core
