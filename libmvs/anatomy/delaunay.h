// Triangle adjacency of a half sheet, and edge flips until the sheet is Delaunay.
#pragma once

#include "anatomy/sheet.h"
#include "model/topology.h"

namespace mvs::core {

// Twice the signed area in (v, theta): positive for every triangle of a valid sheet.
double signed_area(const Place &a, const Place &b, const Place &c);

// Returns whether an edge lies on a column, which its vertices must not leave.
bool on_one_column(const HalfSheet &sheet, uint32_t a, uint32_t b);

// Returns the triangle adjacency: item t, k is the triangle across the edge of triangle t from
// corner k to k + 1, or `none`.
std::vector<Tri> connect(const std::vector<Tri> &triangles);

// Flips edges until the two angles opposite to each sum to at most pi in space (Lawson 1977); keeps
// `across` up to date.
void flip_to_delaunay(HalfSheet &sheet, std::vector<Tri> &across);

}  // namespace mvs::core
