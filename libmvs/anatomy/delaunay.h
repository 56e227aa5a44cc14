// Who touches whom in a sheet, and flipping its edges until they are Delaunay.
#pragma once

#include "anatomy/sheet.h"
#include "model/topology.h"

namespace mvs::core {

// Twice the signed area in (v, theta): positive for every triangle of a valid sheet.
double signed_area(const Place &a, const Place &b, const Place &c);

// Whether an edge runs along a column, which it must not leave.
bool on_one_column(const HalfSheet &sheet, uint32_t a, uint32_t b);

// Item t, k is the triangle over the edge of triangle t from corner k to k + 1, or `none`.
std::vector<Tri> connect(const std::vector<Tri> &triangles);

// Triangles around each vertex, ascending.
Rows rings_of(const HalfSheet &sheet);

// Flips edges until the two angles that face each sum to at most pi in space (Lawson 1977); keeps
// `across` up to date.
void flip_to_delaunay(HalfSheet &sheet, std::vector<Tri> &across);

}  // namespace mvs::core
