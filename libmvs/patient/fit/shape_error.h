// The leak of a closed valve whose shape is known to some error only.
//
// Lengths, free edge and thickness move a valve among the shapes that its model can take. What a
// fit leaves between them and the given closed surface is shared by all of its closures: errors of
// the tissue law, of chordae that are not modelled, of the surface. So a leak is known no better
// than its shape: each free edge may end sooner, and each leaflet lie nearer to the other, by 1.96
// times the remaining distance (RMS; 95 % of normal deviates). The surface shows distances across
// the leaflets only; along them, where they end, it is no better.
//
// Most: the leak of the same shape without the tissue next to the free edge. A valve that seals by
// a narrow band leaks then, and one with a high coaptation does not. Least: the leak through gaps
// that stay open where both leaflets come nearer, each narrower by as much.
#pragma once

#include "patient/fit/surface_match.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// The surface to which a valve was fitted; none: it was not.
struct FittedShape {
  const ClosedSurface *given = nullptr;
  const PatientGeometry *geometry = nullptr;  // of the valve
  double error = usual_closed_error;          // m, of places of the surface, for its gaps
};

struct ShapeLeaks {
  double distance = 0;         // m, between the closed valve and the surface; 0: no surface
  double error = 0;            // m, of the place of an edge
  double least = 0, most = 0;  // m2
};

// Root mean square of the distances of each surface from the other, m; both count half. The tissue
// nearest to a point counts whichever way it faces: an edge that is rounded off in one surface has
// its nearest tissue around the corner.
double distance_between(const ClosedSurface &given, const Model &model, const std::vector<Vec3> &x);
// The distance of the given surface from the valve, m RMS.
double distance_from_valve(const ClosedSurface &given, const Model &model,
                           const std::vector<Vec3> &x);

// The leak, m2, of the same shape with its free edge farther in by `by` (m at rest, along the
// leaflets); where a leaflet is low, by a quarter of its height at most (free_edge_shift.h). The
// nodes of the model begin with the vertices of the sheet of `g`, which is at rest as in the model.
double leak_with_edges_in(const Model &model, const std::vector<Vec3> &x, const PatientGeometry &g,
                          double by);

// The leak, m2, of the same shape with both sides of each gap nearer by `by`, m: a part of the
// orifice keeps the share of its area that its widest gap keeps of its width, which is exact for a
// slit, and is sealed where that is within the contact thickness.
double leak_of_narrower_gaps(const Model &model, const std::vector<Vec3> &x, double by);

// `leak`: of the shape as it is, m2.
ShapeLeaks leaks_of_shape(const Model &model, const std::vector<Vec3> &x, double leak,
                          const FittedShape &fitted);

}  // namespace mvs::core
