// The annulus as a curve, the leaflets along it, and the landmarks that follow.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// A closed polygon by arc length.
class Loop {
 public:
  Loop(const std::vector<uint32_t> &nodes, const std::vector<Vec3> &x);
  explicit Loop(std::vector<Vec3> points);

  size_t size() const { return points_.size(); }
  double length() const { return start_.back(); }
  double start_of(size_t edge) const { return start_[edge]; }  // m from the first point
  const Vec3 &point(size_t k) const { return points_[k % points_.size()]; }
  const std::vector<Vec3> &points() const { return points_; }
  Vec3 at(double s) const;  // any s: the loop goes round

 private:
  std::vector<Vec3> points_;
  std::vector<double> start_;  // one more than there are points: the last is the length
};

// A part of a loop; `to` may exceed the loop's length.
struct Arc {
  double from = 0, to = 0;
  double length() const { return to - from; }
  double middle() const { return 0.5 * (from + to); }
};

// The triangle at each annulus edge (node k to node k + 1); `none` where there is none.
std::vector<uint32_t> annulus_triangles(const Model &model);

// The longest stretch of the annulus that holds a leaflet; of length 0 where it holds none of it
// or where the leaflet goes all the way round, for then it has no ends.
Arc attachment(const Model &model, const Loop &annulus, uint32_t leaflet);

// The leaflet named "A", else the first whose name starts with A or a, else the first.
uint32_t anterior_leaflet(const Valve &valve);

// The stretch that holds the anterior leaflet, with the A point in its middle; without one, the
// half of the loop around its first node.
Arc anterior_stretch(const Model &model, const Loop &annulus);

// Where the anterior leaflet is attached, and what follows from it. Without such a stretch the
// landmarks are the quarter points of the loop, A at its first node.
struct Landmarks {
  Vec3 a;                          // middle, by arc length, of the anterior stretch
  Vec3 p;                          // middle of the rest of the annulus
  std::array<Vec3, 2> commissure;  // where the anterior stretch starts and ends
};
Landmarks find_landmarks(const Model &model, const Loop &annulus);

}  // namespace mvs::core
