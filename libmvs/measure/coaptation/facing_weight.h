// How much a point of the sheet faces other tissue, as a continuous function of all positions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "measure/coaptation/facing_batch.h"
#include "measure/coaptation/facing_tree.h"
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

  // The row of a leaflet, a new one at first.
  FacedLeaflet &of(uint32_t leaflet) {
    for (FacedLeaflet &f : leaflets) {
      if (f.leaflet == leaflet) return f;
    }
    return leaflets.emplace_back(FacedLeaflet{leaflet, 0, Vec3::Zero(), Vec3::Zero()});
  }
};

// The conditions of FacingSurface, each as a smooth ramp in the place of its threshold: distance,
// both directions, and tissue beyond a border. The weight of a point is that of the triangle that
// it faces best, so that it is continuous, with a kink where another triangle takes over.
class FacingWeight {
 public:
  FacingWeight(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
               const FacingTree &tree);

  // From now on points face other leaflets only: a flail scallop and tissue gathered beside a seam
  // lie in folds that touch themselves. A valve with a single leaflet stays as it is.
  void leave_out_folds();
  // Starts with a triangle; returns whether there are triangles that points of it may face.
  bool begin(uint32_t triangle);
  // Weighs points of that triangle. The result is valid until the next call.
  std::span<const Faced> of_points(const FacingPoints &points);
  // Their weights alone.
  FacingPoints::Row weights_of(const FacingPoints &points);
  // Their weights with the triangle that each faces best; `none` where the weight is 0.
  struct Best {
    FacingPoints::Row weight{};
    std::array<uint32_t, FacingPoints::most> triangle{};
  };
  Best best_of(const FacingPoints &points);

 private:
  // A triangle that points may face.
  struct Candidate {
    uint32_t triangle;
    double normals;  // weight of the angle between both normals
  };

  void find_borders();
  void list_candidates();
  // Whether points of the present triangle are not to face that one.
  bool leaves_out(uint32_t triangle) const {
    const auto &leaflet = model_.valve.triangle_leaflet;
    return between_leaflets_ && leaflet[triangle] == leaflet[triangle_];
  }
  // The weight with which a point faces a triangle, from that without its borders.
  double within_borders(uint32_t triangle, const Vec3 &p, double weight) const;
  // Calls visit(triangle, point, pair, weight) for points of the present triangle and triangles
  // that they face, in the order of these triangles; `pair`: their place in pairs_.
  template <typename Visit>
  void for_each_faced(const FacingPoints &points, Visit visit);
  template <typename Visit>
  void weigh(Visit &visit);

  const Model &model_;
  const std::vector<Vec3> &x_;
  const Surface &surface_;
  const FacingTree &tree_;
  double reach_;
  bool between_leaflets_ = false;
  std::vector<uint32_t> first_border_;  // per triangle: border_[first_border_[t] .. [t + 1])
  std::vector<FacingBorder> border_;
  std::vector<uint32_t> first_candidate_;  // per triangle, in the same way
  std::vector<Candidate> candidate_;       // sorted by triangle
  std::vector<FacingBounds> bounds_;       // of each triangle that has candidates
  uint32_t triangle_ = none;
  FacingPairs pairs_;
  std::array<uint32_t, FacingPairs::most> pair_point_{}, pair_triangle_{};
  std::vector<Faced> faced_;  // one per point
};

}  // namespace mvs::core
