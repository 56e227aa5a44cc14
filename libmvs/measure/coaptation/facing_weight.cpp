// Candidates from a triangle tree; sums over the leaflets that points face.
#include "measure/coaptation/facing_weight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mvs::core {
FacingWeight::FacingWeight(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
                           const TriangleBvh &tree)
    : model_(model), x_(x), surface_(surface), tree_(tree), reach_(model.valve.contact_thickness) {
  find_borders();
}

// A triangle is bounded by its border edges, and by the mean direction of the border at a corner.
// The triangle itself may reach out beyond a corner, where the border turns inwards.
void FacingWeight::find_borders() {
  const std::vector<Tri> &triangles = model_.valve.triangles;
  const Topology &topology = model_.topology;
  std::vector<Vec3> node_out(x_.size(), Vec3::Zero());
  const auto out_of = [&](uint32_t t, size_t k) -> Vec3 {
    const Vec3 along = x_[triangles[t][(k + 1) % 3]] - x_[triangles[t][k]];
    return along.cross(surface_.normal[t]);
  };
  const auto is_border = [&](uint32_t t, size_t k) {
    return topology.edge_triangles[topology.triangle_edges[t][k]][1] == none;
  };
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      if (!is_border(t, k)) continue;
      const Vec3 out = out_of(t, k);
      node_out[triangles[t][k]] += out;
      node_out[triangles[t][(k + 1) % 3]] += out;
    }
  }
  first_border_.push_back(0);
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 &corner = x_[triangles[t][k]];
      if (is_border(t, k)) border_.push_back({corner, out_of(t, k).normalized(), 0});
      const Vec3 &mean = node_out[triangles[t][k]];
      if (mean.squaredNorm() == 0) continue;
      const Vec3 out = mean.normalized();
      double most = 0;
      for (const uint32_t node : triangles[t]) most = std::max(most, out.dot(x_[node] - corner));
      border_.push_back({corner, out, most});
    }
    first_border_.push_back(static_cast<uint32_t>(border_.size()));
  }
}

bool FacingWeight::begin(uint32_t triangle) {
  triangle_ = triangle;
  candidates_.clear();
  const Vec3 &normal = surface_.normal[triangle];
  const Tri &own = model_.valve.triangles[triangle];
  const double limit = distance_ramp.to * reach_;
  const Aabb &own_box = tree_.box_of(triangle);
  Aabb box = own_box;
  box.low -= Vec3::Constant(limit);
  box.high += Vec3::Constant(limit);
  tree_.for_overlapping(box, [&](uint32_t t) {
    const double cosine = surface_.normal[t].dot(normal);
    if (cosine >= normals_ramp.to || own_box.distance2(tree_.box_of(t)) >= limit * limit) return;
    if (share_a_node(model_.valve.triangles[t], own)) return;
    double weight = 0;
    fall(cosine, normals_ramp, weight);
    candidates_.push_back({t, weight});
  });
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate &l, const Candidate &r) { return l.triangle < r.triangle; });
  return !candidates_.empty();
}

bool FacingWeight::weigh(const Candidate &candidate, const FacingPoints &points,
                         FacingWeights &found) const {
  const uint32_t t = candidate.triangle;
  const Tri &c = model_.valve.triangles[t];
  const std::span<const FacingBorder> borders(border_.data() + first_border_[t],
                                              border_.data() + first_border_[t + 1]);
  const FacingTriangle triangle = {{x_[c[0]], x_[c[1]], x_[c[2]]},
                                   surface_.normal[t],
                                   tree_.box_of(t),
                                   borders,
                                   candidate.normals};
  return weigh_points(points, surface_.normal[triangle_], triangle, reach_, found);
}

FacingPoints::Row FacingWeight::weights_of(const FacingPoints &points) const {
  FacingPoints::Row weight{};
  FacingWeights found;
  for (const Candidate &candidate : candidates_) {
    if (!weigh(candidate, points, found)) continue;
    for (size_t k = 0; k < points.count; ++k) weight[k] = std::max(weight[k], found.weight[k]);
  }
  return weight;
}

std::span<const Faced> FacingWeight::of_points(const FacingPoints &points) {
  if (faced_.size() < points.count) faced_.resize(points.count);
  for (size_t k = 0; k < points.count; ++k) {
    faced_[k].weight = 0;
    faced_[k].leaflets.clear();
  }
  FacingPoints::Row sum{};
  FacingWeights found;
  for (const Candidate &candidate : candidates_) {
    if (!weigh(candidate, points, found)) continue;
    const uint32_t leaflet = model_.valve.triangle_leaflet[candidate.triangle];
    const Vec3 &normal = surface_.normal[candidate.triangle];
    for (size_t k = 0; k < points.count; ++k) {
      if (found.weight[k] == 0) continue;
      const double rounded = found.distance2[k] / (reach_ * reach_) + nearest_share * nearest_share;
      const double counts = found.weight[k] / (rounded * rounded);
      faced_[k].weight = std::max(faced_[k].weight, found.weight[k]);
      sum[k] += counts;
      FacedLeaflet &of = faced_[k].of(leaflet);
      of.share += counts;
      of.point += counts * Vec3(found.x[k], found.y[k], found.z[k]);
      of.normal += counts * normal;
    }
  }
  for (size_t k = 0; k < points.count; ++k) {
    for (FacedLeaflet &f : faced_[k].leaflets) {
      f.point /= f.share;
      f.normal /= f.share;
      f.share /= sum[k];
    }
  }
  return {faced_.data(), points.count};
}

}  // namespace mvs::core
