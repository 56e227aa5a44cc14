// Matches between a simulated closed valve and a given closed surface, both ways.
#pragma once

#include <vector>

#include "base/types.h"
#include "geometry/triangle_bvh.h"
#include "model/model.h"

namespace mvs::core {

// m: the standard deviation of places of a surface from labels of segmentation networks.
inline constexpr double usual_closed_error = 0.5e-3;

struct ClosedSurface {
  std::vector<Vec3> points;  // m
  std::vector<Tri> triangles;
};

// A point of the valve, as weights of its nodes, and its closest point on the given surface, or the
// other way round. The residual along `direction` is linear in the nodes.
struct SurfaceMatch {
  Tri nodes;
  std::array<double, 3> weight;
  Vec3 target, direction;
  double distance = 0;  // m
  double area = 0;      // m2 that the match stands for

  double residual(const std::vector<Vec3> &x) const {
    const Vec3 y = weight[0] * x[nodes[0]] + weight[1] * x[nodes[1]] + weight[2] * x[nodes[2]];
    return direction.dot(y - target);
  }
  // Derivative of the residual along displacements of the nodes.
  double derivative(const std::vector<Vec3> &dx) const {
    return direction.dot(weight[0] * dx[nodes[0]] + weight[1] * dx[nodes[1]] +
                         weight[2] * dx[nodes[2]]);
  }
};

// Matches of surfaces that face the same way, so that a leaflet is not matched with the one that it
// touches.
class SurfaceMatcher {
 public:
  // Turns each piece of the surface, if that brings it closer to the closed valve. Keeps a
  // reference to `given`.
  SurfaceMatcher(const ClosedSurface &given, const Model &model, const std::vector<Vec3> &x);

  std::vector<SurfaceMatch> match(const Model &model, const std::vector<Vec3> &x) const;

 private:
  void turn_pieces(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);
  // The normal of each given point, by area; zero beside no triangle.
  std::vector<Vec3> given_point_normals() const;

  const ClosedSurface &given_;
  TriangleBvh tree_;
  std::vector<Vec3> normal_;  // of each given triangle
  std::vector<uint32_t> sample_;
  double sample_area_ = 0;  // m2
};

// Root mean square of the distances, by area.
double rms_distance(const std::vector<SurfaceMatch> &matches);

}  // namespace mvs::core
