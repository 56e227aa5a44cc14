// Points of the sheet, and of a wall around it, dense where blood might find a way through.
#pragma once

#include <vector>

#include "measure/annulus/landmarks.h"
#include "measure/orifice/bisect.h"
#include "model/model.h"

namespace mvs::core::orifice {

// The sheet in the valve's frame, z towards the atrium; only the nodes of its triangles.
struct Sheet {
  Mesh mesh;
  std::vector<Edge> rim;  // edges of one triangle: annulus, free edges, holes
  Loop annulus;
  double seal;    // m: a passage up to this width is closed
  double grain;   // m: the finest spacing of samples
  double radius;  // m: the sheet is inside the sphere of this size around the origin
};
// Edges as triangles of no area, for a TriangleBvh.
std::vector<Tri> as_triangles(const std::vector<Edge> &edges);

Sheet local_sheet(const Model &model, const std::vector<Vec3> &local);

struct Samples {
  std::vector<Vec3> point;
  std::vector<double> spacing;  // the longest edge to a neighbour
  size_t on_sheet = 0;          // points from here on belong to the wall
};

// The sheet with edges of `grain` at its rims and wherever another part of it faces it, and twice
// as coarse as the way to either elsewhere; then a wall that goes outwards from the annulus, to
// twice the radius, in rings of growing spacing.
Samples sample(const Sheet &sheet);

}  // namespace mvs::core::orifice
