// Recursive division of places, with the triangles near a ball around them.
#include "measure/regions/region_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mvs::core {
namespace {

// Divides places in the middle of the longest extent of their box: cells of a raster lie evenly,
// so that a median would cost more and divide little better. Places that are all equal are divided
// by number.
std::span<RegionPlace>::iterator divide(std::span<RegionPlace> places) {
  Aabb box;
  for (const RegionPlace &p : places) box.add(p.place);
  Eigen::Index axis;
  (box.high - box.low).maxCoeff(&axis);
  const double middle = 0.5 * (box.low[axis] + box.high[axis]);
  auto end = places.begin();  // not std::partition, whose order depends on the standard library
  for (RegionPlace &p : places) {
    if (p.place[axis] < middle) std::swap(p, *end++);
  }
  if (end != places.begin() && end != places.end()) return end;
  return places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
}

}  // namespace

// The mean is inside the convex hull of the places, so that it is inside every ball around them.
RegionSearch::Ball RegionSearch::ball_of(std::span<const RegionPlace> places) {
  Ball ball = {Vec3::Zero(), 0};
  for (const RegionPlace &p : places) ball.centre += p.place;
  ball.centre /= static_cast<double>(places.size());
  double radius2 = 0;
  for (const RegionPlace &p : places) {
    radius2 = std::max(radius2, (p.place - ball.centre).squaredNorm());
  }
  ball.radius = std::sqrt(radius2);
  return ball;
}

void RegionSearch::fill(std::span<RegionPlace> places, const Ball &ball,
                        const std::vector<uint32_t> &among, size_t depth) {
  nearest_ = list_nearby(tree_, among, ball.centre, ball.radius, near_);
  const bool is_of_one = std::all_of(near_.begin(), near_.end(), [&](const NearTriangle &n) {
    return map_.same_regions(n.triangle, nearest_);
  });
  if (is_of_one || places.size() == 1) {
    for (RegionPlace &p : places) p.tissue = nearest_;
    return;
  }
  if (left_.size() == depth) left_.emplace_back();
  left_[depth].clear();
  // the closest first, which is often the closest to the quarters, too
  left_[depth].push_back(nearest_);
  for (const NearTriangle &n : near_) {
    if (n.triangle != nearest_) left_[depth].push_back(n.triangle);
  }
  const auto middle = divide(places);
  for (const std::span<RegionPlace> half :
       {std::span(places.begin(), middle), std::span(middle, places.end())}) {
    if (half.size() == 1) {
      fill(half, ball_of(half), left_[depth], depth + 1);
      continue;
    }
    const auto quarter = divide(half);
    for (const std::span<RegionPlace> part :
         {std::span(half.begin(), quarter), std::span(quarter, half.end())}) {
      fill(part, ball_of(part), left_[depth], depth + 1);
    }
  }
}

void RegionSearch::find(std::span<RegionPlace> places) {
  if (places.empty()) return;
  const Ball ball = ball_of(places);
  const ClosestNearby near(tree_, ball.centre, ball.radius, nearest_);
  nearest_ = near.closest_to_centre();
  fill(places, ball, near.triangles(), 0);
}

}  // namespace mvs::core
