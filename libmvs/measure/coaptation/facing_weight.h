// How much a point of the sheet faces other tissue, as a continuous function of all positions.
#pragma once

#include <vector>

#include "geometry/bvh.h"
#include "measure/tissue/surface.h"
#include "model/model.h"

namespace mvs::core {

// The tissue of one leaflet that a point faces.
struct FacedLeaflet {
  uint32_t leaflet;
  double share;        // of all tissue that the point faces
  Vec3 point, normal;  // means, the nearest tissue counting most
};

// The weight from 0 to 1 with which a point faces tissue, and that tissue by leaflet.
struct Faced {
  double weight = 0;
  std::vector<FacedLeaflet> leaflets;
};

// The conditions of FacingSurface, each as a smooth ramp in the place of its threshold: distance,
// both directions, and tissue beyond a border. The weight of a point is that of the triangle that
// it faces best, so that it is continuous, with a kink where another triangle takes over.
class FacingWeight {
 public:
  FacingWeight(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
               const TriangleBvh &tree);

  // Starts with a triangle: lists the triangles that points of it may face; returns whether there
  // are any.
  bool begin(uint32_t triangle);
  // Weighs a point of that triangle. The result is valid until the next call.
  const Faced &of_point(const Vec3 &p);
  // Its weight alone.
  double weight_of(const Vec3 &p) const;

 private:
  // A half-plane that bounds a triangle at the border of the sheet.
  struct Border {
    Vec3 from, out;  // unit, in the plane of the triangle
    double beyond;   // m, how far the triangle reaches out itself
  };
  struct Weighed {
    double weight, distance2;
    Vec3 point;
  };

  void find_borders();
  Weighed weigh(uint32_t candidate, const Vec3 &p) const;

  const Model &model_;
  const std::vector<Vec3> &x_;
  const Surface &surface_;
  const TriangleBvh &tree_;
  double reach_;
  std::vector<uint32_t> first_border_;  // per triangle: border_[first_border_[t] .. [t + 1])
  std::vector<Border> border_;
  uint32_t triangle_ = none;
  std::vector<uint32_t> candidates_;
  Faced faced_;
};

}  // namespace mvs::core
