// Spheres around the triangles at rest, and the exact test.
#include "collision/rest_distance_filter.h"

#include <algorithm>
#include <cmath>

#include "collision/contact_params.h"
#include "collision/pair_distance.h"

namespace mvs::core {
namespace {

// Relative, above the rounding error of squares and roots.
constexpr double sphere_error = 1e-9;

}  // namespace

RestDistanceFilter::RestDistanceFilter(const Model &model) : model_(&model) {
  const double needed = contact_rest_distance * model.valve.contact_thickness;
  surely_near2_ = needed * needed * (1 - sphere_error);
  const auto &x = model.valve.rest.get();
  centre_.reserve(model.valve.triangles.size());
  surely_apart2_.reserve(model.valve.triangles.size());
  for (const auto &[i, j, k] : model.valve.triangles) {
    const Vec3 centre = (x[i] + x[j] + x[k]) / 3;
    double radius2 = 0;
    for (const uint32_t corner : {i, j, k}) {
      radius2 = std::max(radius2, (x[corner] - centre).squaredNorm());
    }
    const double clear = needed + std::sqrt(radius2);
    centre_.push_back(centre);
    surely_apart2_.push_back(clear * clear * (1 + sphere_error));
  }
}

bool RestDistanceFilter::is_apart(uint32_t vertex, uint32_t triangle) const {
  return distance_of(model_->valve.rest, vertex, model_->valve.triangles[triangle]) >=
         contact_rest_distance * model_->valve.contact_thickness;
}

}  // namespace mvs::core
