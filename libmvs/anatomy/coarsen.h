// A coarser level of any valve by greedy removal of sheet vertices.
#pragma once

#include "anatomy/coarse_chordae.h"
#include "anatomy/level_map.h"

namespace mvs::core {

// Summary of a coarsening.
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
  LevelMap map;  // from the fine level (the input) to this one
  CoarseningReport report;
};

// Returns a level with this number of sheet vertices. The most crowded vertices are removed first,
// so that edges become even. The order does not depend on the number asked for: the vertices of a
// coarser level are vertices of every finer one made of the same valve.
//
// Remaining vertices keep their place and order, so that results compare with the fine level node
// by node; relaxation, which would move them, is left out, and edge flips keep triangles well
// shaped instead. The annulus, the free edge and the borders of leaflets and scallops lose vertices
// only along themselves; their junctions stay. A vertex with chordae is merged only into one that
// has chordae too, and its chordae move along (CoarseChordae). Thickness and fibres are means over
// the fine triangles.
//
// Throws MVS_E_ARGUMENT if the valve has fewer vertices than asked for, or needs more. `steps`
// (may be null) receives those that concern chordae.
Coarsened coarsen(const Model &model, size_t vertices, std::vector<ChordStep> *steps = nullptr);

// Returns the approximate number of sheet vertices of a level with edges of this length.
size_t vertices_for_edge(const Model &model, double edge);

}  // namespace mvs::core
