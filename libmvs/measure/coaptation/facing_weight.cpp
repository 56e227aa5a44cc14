// Smooth ramps over distance, directions and borders; candidates from a triangle tree.
#include "measure/coaptation/facing_weight.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

// A ramp falls from 1 at its first value to 0 at its second. Their middles are the thresholds of
// FacingSurface.
struct Ramp {
  double from, to;
};
constexpr Ramp distance_ramp = {0.85, 1.15};   // over reach
constexpr Ramp normals_ramp = {-0.6, -0.4};    // cosine between the normals
constexpr Ramp direction_ramp = {-0.6, -0.4};  // minus cosine of normal and direction
constexpr Ramp border_ramp = {0.176, 0.364};   // tangents of 10 and 20 degrees
constexpr Ramp contact_ramp = {0.05, 0.15};    // share of reach: below, directions do not count
constexpr double nearest_share = 0.1;          // of reach: rounds off which tissue is nearest

// 1 before the ramp, 0 behind it, a cubic between.
double fall(double value, const Ramp &ramp) {
  const double s = std::clamp((value - ramp.from) / (ramp.to - ramp.from), 0.0, 1.0);
  return 1 - s * s * (3 - 2 * s);
}

}  // namespace

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
  Aabb box = tree_.box_of(triangle);
  box.low -= Vec3::Constant(distance_ramp.to * reach_);
  box.high += Vec3::Constant(distance_ramp.to * reach_);
  tree_.for_overlapping(box, [&](uint32_t t) {
    if (surface_.normal[t].dot(normal) >= normals_ramp.to) return;
    if (!share_a_node(model_.valve.triangles[t], own)) candidates_.push_back(t);
  });
  std::sort(candidates_.begin(), candidates_.end());
  return !candidates_.empty();
}

FacingWeight::Weighed FacingWeight::weigh(uint32_t candidate, const Vec3 &p) const {
  Weighed none_there{0, 0, Vec3::Zero()};
  const double limit = distance_ramp.to * reach_;
  if (tree_.box_of(candidate).distance2(p) >= limit * limit) return none_there;
  const TrianglePoint q = tree_.closest_on(candidate, p);
  if (q.distance2 >= limit * limit) return none_there;
  const Vec3 &normal = surface_.normal[triangle_], &other = surface_.normal[candidate];
  const double distance = std::sqrt(q.distance2);
  Weighed result{fall(distance / reach_, distance_ramp), q.distance2,
                 tree_.point_at(candidate, q.weight)};
  result.weight *= fall(other.dot(normal), normals_ramp);
  if (distance > contact_ramp.from * reach_) {
    const double off = 1 - fall((p - result.point).dot(normal) / distance, direction_ramp);
    result.weight *= 1 - off * (1 - fall(distance / reach_, contact_ramp));
  }
  for (uint32_t b = first_border_[candidate]; b < first_border_[candidate + 1]; ++b) {
    if (result.weight == 0) return result;
    const Border &border = border_[b];
    const double height = std::max((p - border.from).dot(other), nearest_share * reach_);
    const double out = (p - border.from).dot(border.out) - border.beyond;
    result.weight *= fall(out / height, border_ramp);
  }
  return result;
}

double FacingWeight::weight_of(const Vec3 &p) const {
  double weight = 0;
  for (const uint32_t t : candidates_) weight = std::max(weight, weigh(t, p).weight);
  return weight;
}

const Faced &FacingWeight::of_point(const Vec3 &p) {
  faced_.weight = 0;
  faced_.leaflets.clear();
  double sum = 0;
  for (const uint32_t t : candidates_) {
    const Weighed found = weigh(t, p);
    if (found.weight == 0) continue;
    faced_.weight = std::max(faced_.weight, found.weight);
    const double rounded = found.distance2 / (reach_ * reach_) + nearest_share * nearest_share;
    const double counts = found.weight / (rounded * rounded);
    const uint32_t leaflet = model_.valve.triangle_leaflet[t];
    auto at = std::find_if(faced_.leaflets.begin(), faced_.leaflets.end(),
                           [&](const FacedLeaflet &f) { return f.leaflet == leaflet; });
    if (at == faced_.leaflets.end()) {
      faced_.leaflets.push_back({leaflet, 0, Vec3::Zero(), Vec3::Zero()});
      at = faced_.leaflets.end() - 1;
    }
    at->share += counts;
    at->point += counts * found.point;
    at->normal += counts * surface_.normal[t];
    sum += counts;
  }
  for (FacedLeaflet &f : faced_.leaflets) {
    f.point /= f.share;
    f.normal /= f.share;
    f.share /= sum;
  }
  return faced_;
}

}  // namespace mvs::core
