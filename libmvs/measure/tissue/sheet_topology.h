// Topology of a hierarchy over the leaflets, for all searches of the measures.
#pragma once

#include <memory>

#include "geometry/bvh.h"
#include "model/model.h"

namespace mvs::core {

inline constexpr uint32_t sheet_leaf = 4;  // triangles, of each leaf but the last

// The topology of a TriangleBvh or FacingTree over the triangles at rest, from any thread. No
// result of a search depends on it, and it serves folded leaflets as well, as neighbours stay
// neighbours. The process keeps those of the last few meshes, as a mesh stays while its valve is
// closed and its chordae are operated on.
std::shared_ptr<const BvhTopology> sheet_topology(const Model &model);

}  // namespace mvs::core
