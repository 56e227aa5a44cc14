// Annulus and free edge of a sheet, and its orientation.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// m: an annulus farther from the rim, or from a closed surface, in the mean is of another frame or
// patient. Points by hand on images of 0.7 mm lie within 3 mm; the height of the leaflets is 10 mm
// and more.
constexpr double farthest_annulus = 8e-3;

// m: the annulus of a small adult valve. Heights and widths of valves with a smaller one scale with
// it.
inline constexpr double whole_annulus = 100e-3;

// Known landmarks; empty: not known.
struct RimLandmarks {
  std::vector<Vec3> annulus;  // points along it, in any order
  std::vector<Vec3> tips;     // of the papillary muscles
};

// Cuts tissue of the atrium off along given annulus points (cut_annulus.h), fills gaps that open to
// a rim in one point and holes (loops shorter than a fifth of the longest one, and longer ones that
// are narrow and lie in the plane of one leaflet), finds which of the two rims is the annulus
// (nearer to given annulus points, else farther from given tips, else larger, rounder and
// smoother), and turns the triangles so that their normals point into the atrium: the annulus, in
// the order in which the triangles pass along it, runs counter-clockwise seen from there. `sheet`
// is one piece as clean_surface() makes it. Throws unless there are two rims and no handle, on
// landmarks of another frame, and on leaflets that are closed.
SheetRims find_rims(LeafletSheet &sheet, const RimLandmarks &landmarks, Findings &findings);

}  // namespace mvs::core
