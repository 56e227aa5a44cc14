// Local subproblem (one subdomain of a domain decomposition): a model of the neighbourhood of some
// nodes, for settling what one operation disturbed.
//
// Nodes near the disturbance are free, the others are prescribed where they are. The subproblem has
// every triangle that a free node could meet within `max_displacement`. While no free node moves
// farther, the subproblem cannot pass through the rest of the valve, and the forces on its free
// nodes are those of the whole valve.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct LocalSubproblem {
  Model model;                 // the parts that TotalEnergy reads; no names, masses or fibres
  std::vector<uint32_t> node;  // of the whole valve, by node of the subproblem
};

struct LocalExtent {
  double radius;            // m: free nodes are within this distance of the disturbed nodes,
  size_t max_nodes;         // and only about so many, the nearest
  double max_displacement;  // m, of a free node
};

// Distances are those of the present shape x, so that tissue in contact is part of the subproblem.
LocalSubproblem make_local_subproblem(const Model &whole, const std::vector<Vec3> &x,
                                      const std::vector<uint32_t> &disturbed,
                                      const LocalExtent &extent);

}  // namespace mvs::core
