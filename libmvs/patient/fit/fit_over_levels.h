// A fit of a fine valve, searched on a coarser mesh of it.
//
// Most of a fit is closures: a search makes about a hundred. The lengths with which a valve meets a
// surface depend little on its mesh, as chordae keep their slack when they are coarsened
// (anatomy/coarsen.h). So the lengths are sought on the coarse mesh, the fine valve is closed with
// them, and only if it lies farther from the surface than the coarse one are the groups of chordae
// improved on the fine mesh.
#pragma once

#include "patient/fit/fit_to_closed.h"

namespace mvs::core {

// Vertices of the mesh of a search: 0.1 to 0.2 mm from finer ones, below the error of a
// segmentation.
inline constexpr size_t search_vertices = 1000;

// As fit_to_closed(), which it is for valves with less than one and a half times `coarse` vertices,
// and for those that cannot be coarsened so far.
ChordFit fit_over_levels(Valve &valve, const ClosedSurface &given, const FitSettings &settings,
                         Findings &findings, const TellShare &tell = {},
                         size_t coarse = search_vertices);

}  // namespace mvs::core
