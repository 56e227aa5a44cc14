// Point samples of the sheet and of a wall around it, dense where an opening is possible.
#pragma once

#include <vector>

#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"
#include "measure/orifice/bisect.h"
#include "model/sides.h"

namespace mvs::core::orifice {

// The sheet in the valve's frame, z towards the atrium, with the nodes of its triangles only. It
// may have any number of pieces.
struct Sheet {
  Mesh mesh;
  std::vector<Side> rim;  // without a triangle on the other side: annulus, free edges, holes
  Loop annulus;
  double seal;    // m: a passage up to this width is sealed
  double grain;   // m: the finest spacing of samples
  double radius;  // m: the sheet is inside the sphere of this size around the origin
};
// Returns the edges of sides as degenerate triangles for a TriangleBvh.
std::vector<Tri> as_triangles(const std::vector<Side> &sides);

// Triangles over `points` within the annulus of a model in shape `x`, whose frame is given.
Sheet local_sheet(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                  const Model &model, const std::vector<Vec3> &x, const Frame &frame);

struct Samples {
  std::vector<Vec3> point;
  std::vector<double> spacing;  // the longest edge to a neighbour
  size_t on_sheet = 0;          // points from here on belong to the wall
};

// Samples the sheet with edges of half the distance to tissue opposite to it or to its rim, from
// `grain` to 4 `grain`, and growing edges around them; then adds a wall that extends outwards from
// the annulus to twice the radius, in rings of growing spacing.
Samples sample(const Sheet &sheet);

}  // namespace mvs::core::orifice
