// Rest distance filter: selects the vertex-triangle pairs that can be in contact, those that are at
// least contact_rest_distance times the contact thickness apart in the rest shape. Spheres around
// the triangles decide most pairs, the exact distance the others.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

class RestDistanceFilter {
 public:
  // The model must outlive the filter.
  explicit RestDistanceFilter(const Model &model);

  bool operator()(uint32_t vertex, uint32_t triangle) const {
    const double centre2 = (model_->valve.rest[vertex] - centre_[triangle]).squaredNorm();
    if (centre2 < surely_near2_) return false;
    return centre2 >= surely_apart2_[triangle] || is_apart(vertex, triangle);
  }

 private:
  bool is_apart(uint32_t vertex, uint32_t triangle) const;

  const Model *model_;
  double surely_near2_;                // m2, from the centre
  std::vector<Vec3> centre_;           // of each triangle
  std::vector<double> surely_apart2_;  // m2, from the centre: then all of the triangle is apart
};

}  // namespace mvs::core
