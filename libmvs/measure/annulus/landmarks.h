// The annulus as a curve, the attachment of leaflets along it, and anatomical landmarks.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// Length of an open polygon.
double polyline_length(const std::vector<Vec3> &points);

// A closed polygon parametrised by arc length.
class Loop {
 public:
  Loop(const std::vector<uint32_t> &nodes, const std::vector<Vec3> &x);
  explicit Loop(std::vector<Vec3> points);

  size_t size() const { return points_.size(); }
  double length() const { return start_.back(); }
  double start_of(size_t edge) const { return start_[edge]; }  // m from the first point
  const Vec3 &point(size_t k) const { return points_[k % points_.size()]; }
  const std::vector<Vec3> &points() const { return points_; }
  Vec3 at(double s) const;  // any s, periodic

 private:
  std::vector<Vec3> points_;
  std::vector<double> start_;  // one per point, then the total length
};

// Centroid of a loop by arc length.
Vec3 centroid(const Loop &loop);

// Second moments of a loop about a point, by arc length, m3; exact along each edge.
Mat3 second_moments(const Loop &loop, const Vec3 &about);

// A part of a loop; `to` may exceed the loop's length.
struct Arc {
  double from = 0, to = 0;
  double length() const { return to - from; }
  double middle() const { return 0.5 * (from + to); }
};

// Returns the triangle at each annulus edge (node k to node k + 1), or `none`.
std::vector<uint32_t> annulus_triangles(const Model &model);

// Returns the longest stretch of the annulus to which a leaflet is attached. Its length is 0 if the
// leaflet is not attached, or attached along the whole annulus, in which case it has no ends.
Arc attachment(const Model &model, const Loop &annulus, uint32_t leaflet);

// Returns the leaflet named "A", else the first whose name starts with A or a, else the first.
uint32_t anterior_leaflet(const Valve &valve);

// Returns the attachment of the anterior leaflet, with the A point in its middle; without an
// attachment, the half of the loop around its first node.
Arc anterior_stretch(const Model &model, const Loop &annulus);

// Landmarks from the attachment of the anterior leaflet. Without an attachment they are the quarter
// points of the loop, A at its first node.
struct Landmarks {
  Vec3 a;                          // middle, by arc length, of the anterior stretch
  Vec3 p;                          // middle of the rest of the annulus
  std::array<Vec3, 2> commissure;  // where the anterior stretch starts and ends
};
Landmarks find_landmarks(const Model &model, const Loop &annulus);

}  // namespace mvs::core
