// Places on a triangle surface, and the closest point that a walk over neighbouring triangles
// reaches.
#pragma once

#include "model/compressed_rows.h"
#include "patient/annulus/closed_curve.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

struct SurfacePlace {
  uint32_t triangle = none;
  std::array<double, 3> weight{};  // of its corners
};

// Keeps references to vertices and triangles: they must outlive it.
class SurfaceWalk {
 public:
  // Normals are averaged over about `scale` (m) around each vertex, if triangles are much smaller.
  SurfaceWalk(const std::vector<Vec3> &x, const std::vector<Tri> &triangles, double scale = 0);

  Vec3 at(const SurfacePlace &place) const;
  // The vertex normals (means weighted by area), interpolated; a unit vector.
  Vec3 normal_at(const SurfacePlace &place) const;

  // Descends from `start` to the place whose distance from p no neighbouring triangle improves. The
  // path is continuous on the surface: it never leaves for a wall that is near p but far along the
  // surface, as the closest point of all triangles does.
  SurfacePlace closest_from(const SurfacePlace &start, const Vec3 &p) const;

 private:
  void average_normals(double scale);

  const std::vector<Vec3> &x_;
  const std::vector<Tri> &triangles_;
  Rows stars_;
  std::vector<Vec3> normal_;  // of each vertex
};

// A boundary loop as a closed curve with arc length.
class RimCurve {
 public:
  // Throws if two vertices in turn are not joined by a side of exactly one triangle.
  RimCurve(const LeafletSheet &sheet, const std::vector<uint32_t> &loop, const char *name);

  double length() const { return line_.length(); }
  double start_of(size_t corner) const { return line_.start_of(corner); }
  Vec3 at(double s) const { return line_.at(s); }
  SurfacePlace place_at(double s) const;
  // Arc lengths of the corners that stand out by more than `height` from the chord that reaches
  // `reach` to either side, and more than all others within `reach`.
  std::vector<double> corners(double reach, double height) const;

 private:
  ClosedCurve line_;
  std::vector<uint32_t> triangle_;
  std::vector<Edge> corner_;  // of the triangle: those of the segment's ends
};

}  // namespace mvs::core
