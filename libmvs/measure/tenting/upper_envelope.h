// Upper envelope of the leaflets along the rows of a raster: exact mean heights of cells.
#pragma once

#include <vector>

#include "measure/annulus/annulus_map.h"

namespace mvs::core {

// Per cell of the map: the share of the cell that lies inside the annulus and below tissue, and the
// mean height of the highest tissue there (0 without any). A cell stands for its part of the line
// through the centres of its row.
struct VisibleTissue {
  std::vector<double> covered, height;
};

// The mean of the upper envelope of the triangles over each cell, exact along its row: the row cuts
// triangles in segments, and the highest of them counts. Tissue that is far below the rest of a
// cell counts as if it were `most` below the mean: a narrow gap is as deep in a cell as a ball sees
// it. Covered share, and height where that is not 0, are continuous in all positions, also where a
// fold or a free edge passes a cell: samples at centres would jump there. `local` are the nodes in
// the frame of the map.
VisibleTissue visible_tissue(const AnnulusMap &map, const std::vector<Tri> &triangles,
                             const std::vector<Vec3> &local, double most);

}  // namespace mvs::core
