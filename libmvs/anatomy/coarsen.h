// A coarser level of any valve: vertices are taken out of its sheet one by one.
#pragma once

#include "anatomy/level_map.h"

namespace mvs::core {

// What coarsening did to the valve.
struct CoarseningReport {
  size_t vertices_before = 0, vertices = 0;  // of the sheet
  uint32_t chords_moved = 0;                 // chordae that end at another vertex
  uint32_t chords_merged = 0;                // chordae that became part of another one
  double chord_move = 0;                     // m, largest of these moves
  double surface_max = 0;    // m, largest distance of a vertex taken out from the coarse sheet
  double surface_rms = 0;    // m, of all fine vertices
  double worst_quality = 1;  // of a triangle: 1 equilateral, 0 flat
};

struct Coarsened {
  ModelPtr model;
  LevelMap map;  // from the valve it was made of, the fine level, to this one
  CoarseningReport report;
};

// Leaves this many vertices of the sheet. The crowded ones go first, so that edges become even; the
// order does not depend on the number asked for, so that the vertices of a coarser level are
// vertices of every finer one made of the same valve.
//
// Vertices that stay keep their place and order: results can be compared with those of the fine
// level node by node, and relaxation, which would move them, is left out; flips of sides keep
// triangles in shape instead. The annulus, the free edge, and the borders of leaflets and scallops
// lose vertices along themselves only; where they meet nothing goes. A vertex with chordae goes
// only to one that has chordae too, and they go with it (CoarseChordae). Thickness and fibres are
// means over the fine triangles that a coarse one stands for.
//
// Throws MVS_E_ARGUMENT where the valve has fewer vertices than asked for, or needs more.
Coarsened coarsen(const Model &model, size_t vertices);

// How many vertices of the sheet a level with edges of this length has, about.
size_t vertices_for_edge(const Model &model, double edge);

}  // namespace mvs::core
