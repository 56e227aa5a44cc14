// Sections of triangles by the rows of a raster.
#pragma once

#include <algorithm>
#include <vector>

#include "measure/annulus/annulus_map.h"

namespace mvs::core {

// The segment in which a row cuts a triangle: from < to along the row, and the heights there.
struct Section {
  double from, to, at_from, at_to;

  double height(double u) const {
    return at_from + std::clamp((u - from) / (to - from), 0.0, 1.0) * (at_to - at_from);
  }
};

// The sections of all triangles, row after row: those of row r are [first[r], first[r + 1]).
struct Sections {
  std::vector<size_t> first;
  std::vector<Section> items;
};

// Cuts triangles by the lines through the centres of rows. Triangles that share a side get the same
// bits for the point in which a row cuts it. `local` are the nodes in the frame of the map.
Sections cut_triangles(const AnnulusMap &map, const std::vector<Tri> &triangles,
                       const std::vector<Vec3> &local);

}  // namespace mvs::core
