// Which vertices and triangles face each other: those that are apart in the rest shape.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

class RestDistanceFilter {
 public:
  // The model is there as long as this.
  explicit RestDistanceFilter(const Model &model);

  bool operator()(uint32_t vertex, uint32_t triangle) const {
    const double centre2 = (model_->valve.rest[vertex] - centre_[triangle]).squaredNorm();
    if (centre2 < surely_near2_) return false;
    return centre2 >= surely_apart2_[triangle] || is_apart(vertex, triangle);
  }

 private:
  bool is_apart(uint32_t vertex, uint32_t triangle) const;

  const Model *model_;
  double surely_near2_;
  std::vector<Vec3> centre_;           // of each triangle
  std::vector<double> surely_apart2_;  // what is as far from there has all of the triangle so far
};

}  // namespace mvs::core
