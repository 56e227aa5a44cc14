// Small handles of a surface are cut and closed: tunnels through the tissue, bridges between
// leaflets.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// m around: tunnels and bridges of up to 4 mm across, five voxels of an ultrasound image. The
// tissue itself is farther around, more than 14 mm at a commissure 6 mm high.
inline constexpr double longest_handle = 12e-3;

// Cuts a surface along its shortest loops that do not separate it (shortest_loops.h), until `kept`
// handles remain or the shortest loop is longer than longest_handle, closes both sides of each cut
// with triangles and smooths them. Returns the number of handles that remain. Adds a finding if
// there was a cut. Needs triangles wound alike with normals out of the tissue if it is a skin.
size_t cut_handles(LeafletSheet &surface, size_t kept, Findings &findings);

}  // namespace mvs::core
