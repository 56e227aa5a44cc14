// A closed polygon in space, by arc length, and how another one lies along it.
#pragma once

#include <vector>

#include "base/types.h"

namespace mvs::core {

class ClosedCurve {
 public:
  explicit ClosedCurve(std::vector<Vec3> corners);

  size_t size() const { return corners_.size(); }
  const Vec3 &corner(size_t k) const { return corners_[k]; }
  double length() const { return start_.back(); }  // m
  double start_of(size_t corner) const {
    return start_[corner];
  }  // m, arc length; of size(): length()
  // The side that holds an arc length, in any lap, and the share of it.
  struct OnSide {
    size_t side;
    double share;
  };
  OnSide locate(double s) const;
  // The point at an arc length, in any lap.
  Vec3 at(double s) const;
  // The arc length of the nearest point, in [0, length()).
  double nearest(const Vec3 &p) const;
  // The same curve the other way round.
  ClosedCurve reversed() const;

 private:
  std::vector<Vec3> corners_;
  std::vector<double> start_;  // m, arc length of each corner, and of the first one a lap later
};

// The points of a loop of vertices.
std::vector<Vec3> points_along(const std::vector<uint32_t> &loop, const std::vector<Vec3> &x);

// Arc lengths on `curve` for the points of a loop that lies near it, in their order, each larger
// than the one before it, over one lap. Nearest points crowd at corners of the curve and leave gaps
// elsewhere; so the points keep the distances that they have in the loop, but for what differs over
// an eighth of a lap and more. Empty if the loop does not run around once with the curve.
std::vector<double> places_along(const ClosedCurve &curve, const std::vector<Vec3> &loop);

}  // namespace mvs::core
