// Distances between surfaces: samples of one to the exact closest points of the other.
#pragma once

#include <vector>

#include "geometry/triangle_bvh.h"

namespace mvs::core {

// A surface with samples: corners and centroids of its triangles with weights in m2 that integrate
// quadratic functions exactly, such as the squared distance to a plane.
class SampledSurface {
 public:
  // Keeps references to both arguments, which must outlive it.
  SampledSurface(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

  struct Sample {
    Vec3 point;
    double weight;
  };
  const std::vector<Sample> &samples() const { return samples_; }
  const TriangleBvh &tree() const { return tree_; }
  Vec3 normal(uint32_t triangle) const;  // unit; zero where it has no area

 private:
  const std::vector<Tri> &triangles_;
  const std::vector<Vec3> &x_;
  TriangleBvh tree_;
  std::vector<Sample> samples_;
};

// Integrals of squared distance over samples, and the largest distance.
struct SurfaceDistance {
  double squares = 0;  // m4
  double area = 0;     // m2
  double max = 0;      // m

  double rms() const;
};
SurfaceDistance operator+(const SurfaceDistance &l, const SurfaceDistance &r);

}  // namespace mvs::core
