// Delaunay tetrahedralisation of points on an integer lattice, exact: no rounding, no tolerance.
// Incremental insertion (Bowyer 1981, Watson 1981) in a biased randomised order (Amenta, Choi, Rote
// 2003).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace mvs::core {

// Coordinates of points are 1 .. lattice_size - 1; the corners of the box have 0 and lattice_size.
// With 20 bits, the sphere test stays below 2^107 and fits 128-bit integers.
inline constexpr int32_t lattice_size = 1 << 20;
using LatticePoint = std::array<int32_t, 3>;

struct Tetrahedron {
  std::array<uint32_t, 4> corner;     // positive volume, see orient3d_sign()
  std::array<uint32_t, 4> neighbour;  // k lies opposite corner k; `none` outside the box
};

// The tetrahedra fill the box. With n points, vertex n + k is corner k of the box: bits 0, 1, 2 of
// k are set if it is at the far end of x, y, z.
struct Delaunay {
  std::vector<Tetrahedron> tetrahedra;
  std::vector<uint32_t> stands_for;  // of each point: itself, or the first one in the same place
};

// Points are inserted in rounds of doubling size, each along a space-filling curve: nearly linear
// time for points on surfaces.
Delaunay delaunay(const std::vector<LatticePoint> &points);

}  // namespace mvs::core
