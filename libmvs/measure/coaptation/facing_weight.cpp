// Candidates from a triangle tree; sums over the leaflets that points face.
#include "measure/coaptation/facing_weight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

// The number of the lowest bit of four.
constexpr std::array<uint8_t, 16> lowest_of_four = {0, 0, 1, 0, 2, 0, 1, 0, 3, 0, 1, 0, 2, 0, 1, 0};

}  // namespace

FacingWeight::FacingWeight(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
                           const FacingTree &tree)
    : model_(model), x_(x), surface_(surface), tree_(tree), reach_(model.valve.contact_thickness) {
  find_borders();
  list_candidates();
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

// All triangles at once: each pair of triangles is looked at once, for both of them.
void FacingWeight::list_candidates() {
  struct Pair {
    uint32_t a, b;
    double normals;
  };
  const std::vector<Tri> &triangles = model_.valve.triangles;
  const double limit = distance_ramp.to * reach_;
  std::vector<Pair> pairs;
  first_candidate_.assign(triangles.size() + 1, 0);
  tree_.for_near_pairs(normals_ramp.to, limit * limit, [&](uint32_t a, uint32_t b) {
    const double cosine = surface_.normal[a].dot(surface_.normal[b]);
    if (cosine >= normals_ramp.to) return;
    if (tree_.box_of(a).distance2(tree_.box_of(b)) >= limit * limit) return;
    if (share_a_node(triangles[a], triangles[b])) return;
    double weight = 0;
    fall(cosine, normals_ramp, weight);
    pairs.push_back({a, b, weight});
    ++first_candidate_[a + 1];
    ++first_candidate_[b + 1];
  });
  for (size_t t = 0; t < triangles.size(); ++t) first_candidate_[t + 1] += first_candidate_[t];
  std::vector<uint32_t> next(first_candidate_.begin(), first_candidate_.end() - 1);
  candidate_.resize(2 * pairs.size());
  for (const Pair &pair : pairs) {
    candidate_[next[pair.a]++] = {pair.b, pair.normals};
    candidate_[next[pair.b]++] = {pair.a, pair.normals};
  }
  bounds_.resize(triangles.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (!begin(t)) continue;
    const Tri &c = triangles[t];
    bounds_[t] = bounds_of({x_[c[0]], x_[c[1]], x_[c[2]]}, surface_.normal[t], tree_.box_of(t));
    std::sort(candidate_.begin() + first_candidate_[t],
              candidate_.begin() + first_candidate_[t + 1],
              [](const Candidate &l, const Candidate &r) { return l.triangle < r.triangle; });
  }
}

void FacingWeight::leave_out_folds() {
  between_leaflets_ = model_.valve.leaflets.size() > 1;
}

bool FacingWeight::begin(uint32_t triangle) {
  triangle_ = triangle;
  return first_candidate_[triangle] < first_candidate_[triangle + 1];
}

double FacingWeight::within_borders(uint32_t triangle, const Vec3 &p, double weight) const {
  const double least = nearest_share * reach_;
  for (uint32_t k = first_border_[triangle]; k < first_border_[triangle + 1]; ++k) {
    const FacingBorder &border = border_[k];
    const Vec3 from = p - border.from;
    const double height = from.dot(surface_.normal[triangle]);
    double inside = 0;
    fall((from.dot(border.out) - border.beyond) / (height < least ? least : height), border_ramp,
         inside);
    weight *= inside;
  }
  return weight;
}

// Weighs the pairs gathered so far, and begins anew.
template <typename Visit>
void FacingWeight::weigh(Visit &visit) {
  weigh_pairs(surface_.normal[triangle_], reach_, pairs_);
  for (size_t pair = 0; pair < pairs_.count; ++pair) {
    if (pairs_.weight[pair] == 0) continue;
    const Vec3 p(pairs_.p.x[pair], pairs_.p.y[pair], pairs_.p.z[pair]);
    const uint32_t t = pair_triangle_[pair];
    const bool has_border = first_border_[t] < first_border_[t + 1];
    const double weight =
        has_border ? within_borders(t, p, pairs_.weight[pair]) : pairs_.weight[pair];
    if (weight != 0) visit(t, pair_point_[pair], pair, weight);
  }
  pairs_.count = 0;
}

// Only points near a triangle can have a weight.
template <typename Visit>
void FacingWeight::for_each_faced(const FacingPoints &points, Visit visit) {
  const double limit = distance_ramp.to * reach_;
  NearFours near;
  pairs_.count = 0;
  for (uint32_t i = first_candidate_[triangle_]; i < first_candidate_[triangle_ + 1]; ++i) {
    const uint32_t t = candidate_[i].triangle;
    if (leaves_out(t)) continue;
    const Tri &c = model_.valve.triangles[t];
    const Vec3 a = x_[c[0]], b = x_[c[1]], d = x_[c[2]];
    mark_near(bounds_[t], points, limit * limit, near);
    for (uint32_t first = 0; first < points.count; first += 4) {
      for (uint32_t bits = near[first / 4]; bits != 0; bits &= bits - 1) {
        const uint32_t k = first + lowest_of_four[bits];
        if (pairs_.count == FacingPairs::most) weigh(visit);
        const size_t pair = pairs_.count++;
        pairs_.p.set(pair, {points.x[k], points.y[k], points.z[k]});
        pairs_.a.set(pair, a);
        pairs_.b.set(pair, b);
        pairs_.c.set(pair, d);
        pairs_.normals[pair] = candidate_[i].normals;
        pair_point_[pair] = k;
        pair_triangle_[pair] = t;
      }
    }
  }
  weigh(visit);
}

FacingPoints::Row FacingWeight::weights_of(const FacingPoints &points) {
  FacingPoints::Row weights{};
  for_each_faced(points, [&](uint32_t, uint32_t k, size_t, double weight) {
    weights[k] = std::max(weights[k], weight);
  });
  return weights;
}

FacingWeight::Best FacingWeight::best_of(const FacingPoints &points) {
  Best best;
  best.triangle.fill(none);
  for_each_faced(points, [&](uint32_t t, uint32_t k, size_t, double weight) {
    if (weight <= best.weight[k]) return;
    best.weight[k] = weight;
    best.triangle[k] = t;
  });
  return best;
}

std::span<const Faced> FacingWeight::of_points(const FacingPoints &points) {
  if (faced_.size() < points.count) faced_.resize(points.count);
  for (size_t k = 0; k < points.count; ++k) {
    faced_[k].weight = 0;
    faced_[k].leaflets.clear();
  }
  FacingPoints::Row sum{};
  for_each_faced(points, [&](uint32_t t, uint32_t k, size_t pair, double weight) {
    const double rounded =
        pairs_.distance2[pair] / (reach_ * reach_) + nearest_share * nearest_share;
    const double counts = weight / (rounded * rounded);
    faced_[k].weight = std::max(faced_[k].weight, weight);
    sum[k] += counts;
    FacedLeaflet &of = faced_[k].of(model_.valve.triangle_leaflet[t]);
    of.share += counts;
    of.point +=
        counts * Vec3(pairs_.nearest.x[pair], pairs_.nearest.y[pair], pairs_.nearest.z[pair]);
    of.normal += counts * surface_.normal[t];
  });
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
