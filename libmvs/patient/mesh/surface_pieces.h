// Pieces of a surface that are not connected: their areas, rims that meet, and which are too many.
#pragma once

#include <cstdint>
#include <vector>

#include "patient/leaflet_sheet.h"
#include "patient/surface/manifold.h"

namespace mvs::core {

struct SurfacePieces {
  std::vector<uint32_t> of_triangle;
  std::vector<double> area;  // m2
  uint32_t largest = 0;

  // How many have this area or more.
  size_t count(double least) const;
  // Marks the triangles of the largest.
  std::vector<uint8_t> marks_of_largest() const;
};

SurfacePieces measured_pieces(const LeafletSheet &sheet, const std::vector<uint32_t> &across);

// Points of the rims of two or more pieces that lie within `distance` of each other, also over
// other points of rims, become one vertex. Returns the number of vertices that went.
size_t join_rims(LeafletSheet &sheet, const std::vector<uint32_t> &across,
                 const SurfacePieces &pieces, double distance);

// Fails with MVS_E_OP: the areas of the pieces of `least` or more, of which there are two or more,
// and where the second largest lies nearest to the largest.
[[noreturn]] void refuse_pieces(const LeafletSheet &sheet, const SurfacePieces &pieces,
                                double least, const SurfaceJoin &join);

}  // namespace mvs::core
