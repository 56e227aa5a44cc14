// The formulas of FacingWeight on dual numbers, for one sample and the triangle that it faces best.
#include "sensitivity/coaptation_gradient.h"

#include <algorithm>

#include "base/error.h"
#include "measure/coaptation/coaptation_parts.h"
#include "measure/coaptation/facing_tree.h"
#include "measure/coaptation/facing_weight.h"
#include "measure/tissue/surface.h"
#include "sensitivity/dual.h"

namespace mvs::core {
namespace {

// A border edge of the sheet: side k of a triangle.
struct BorderSide {
  uint32_t triangle;
  size_t k;
};

Dual fall_of(const Dual &value, const Ramp &ramp) {
  const double width = ramp.to - ramp.from, s = (value.value - ramp.from) / width;
  if (s <= 0) return {1, value.count};
  if (s >= 1) return {0, value.count};
  return Dual::chain(value, 1 - s * s * (3 - 2 * s), -6 * s * (1 - s) / width);
}

class SampleWeight {
 public:
  SampleWeight(const Model &model, const std::vector<Vec3> &x) : model_(model), x_(x) {
    sides_of_.resize(x.size());
    for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
      for (size_t k = 0; k < 3; ++k) {
        if (!is_border(t, k)) continue;
        const Tri &c = model.valve.triangles[t];
        for (const uint32_t node : {c[k], c[(k + 1) % 3]}) sides_of_[node].push_back({t, k});
      }
    }
  }

  // Adds `times` the gradient of the weight with which the point w of triangle t faces triangle s.
  void add_gradient(uint32_t t, const std::array<double, 3> &w, uint32_t s, double times,
                    NodeField &g) {
    collect_nodes(t, s);
    const Dual weight = weigh(t, w, s);
    for (uint32_t n = 0; n < nodes_.size(); ++n) {
      for (uint32_t k = 0; k < 3; ++k) {
        g[nodes_[n]][k] += times * weight.slope[3 * n + k];
      }
    }
  }

 private:
  bool is_border(uint32_t t, size_t k) const {
    const Topology &topology = model_.topology;
    return topology.edge_triangles[topology.triangle_edges[t][k]][1] == none;
  }

  void collect(uint32_t triangle) {
    for (const uint32_t node : model_.valve.triangles[triangle]) {
      if (std::find(nodes_.begin(), nodes_.end(), node) == nodes_.end()) nodes_.push_back(node);
    }
  }

  // The nodes that the weight depends on: of both triangles, and of those at the border of s.
  void collect_nodes(uint32_t t, uint32_t s) {
    nodes_.clear();
    collect(t);
    collect(s);
    for (const uint32_t node : model_.valve.triangles[s]) {
      for (const BorderSide &side : sides_of_[node]) collect(side.triangle);
    }
    MVS_MUST(3 * nodes_.size() <= Dual::most, MVS_E_UNSUPPORTED, "coaptation_area",
             "more than %u nodes lie along the border at triangle %u: the derivative of the "
             "coaptation area is not available",
             Dual::most / 3, s);
  }

  Dual constant(double value) const { return {value, static_cast<uint32_t>(3 * nodes_.size())}; }

  Dual3 at(uint32_t node) const {
    const auto n =
        static_cast<uint32_t>(std::find(nodes_.begin(), nodes_.end(), node) - nodes_.begin());
    Dual3 p{constant(x_[node][0]), constant(x_[node][1]), constant(x_[node][2])};
    p.x.slope[3 * n] = p.y.slope[3 * n + 1] = p.z.slope[3 * n + 2] = 1;
    return p;
  }
  Dual3 corner(uint32_t t, size_t k) const { return at(model_.valve.triangles[t][k % 3]); }

  Dual3 normal(uint32_t t) const {
    const Dual3 a = corner(t, 0);
    return normalised(cross(corner(t, 1) - a, corner(t, 2) - a));
  }

  // Out of side k of a triangle, in its plane; as long as the side.
  Dual3 out_of(uint32_t t, size_t k) const {
    return cross(corner(t, k + 1) - corner(t, k), normal(t));
  }

  Dual3 nearest(const Dual3 &p, uint32_t s) const {
    const Tri &c = model_.valve.triangles[s];
    const TrianglePoint foot =
        closest_on_triangle({p.x.value, p.y.value, p.z.value}, x_[c[0]], x_[c[1]], x_[c[2]]);
    if (foot.feature < 3) return corner(s, foot.feature);
    if (foot.feature == 6) {
      const Dual3 n = normal(s);
      return p - dot(p - corner(s, 0), n) * n;
    }
    const Dual3 a = corner(s, foot.feature - 3), along = corner(s, foot.feature - 2) - a;
    return a + (dot(p - a, along) / dot(along, along)) * along;
  }

  // Whether the point is within one border of s.
  Dual within(const Dual3 &from, const Dual3 &out, const Dual &beyond, const Dual3 &n) const {
    const double least = nearest_share * model_.valve.contact_thickness;
    const Dual height = dot(from, n);
    const Dual over = dot(from, out) - beyond;
    return fall_of(height.value < least ? (1 / least) * over : over / height, border_ramp);
  }

  Dual within_borders(const Dual3 &p, uint32_t s) const {
    Dual weight = constant(1);
    const Dual3 n = normal(s);
    for (size_t k = 0; k < 3; ++k) {
      const Dual3 from = p - corner(s, k);
      if (is_border(s, k)) {
        weight = weight * within(from, normalised(out_of(s, k)), constant(0), n);
      }
      const std::vector<BorderSide> &sides = sides_of_[model_.valve.triangles[s][k]];
      if (sides.empty()) continue;
      Dual3 sum{constant(0), constant(0), constant(0)};
      for (const BorderSide &side : sides) sum = sum + out_of(side.triangle, side.k);
      const Dual3 out = normalised(sum);
      Dual beyond = constant(0);
      for (size_t j = 0; j < 3; ++j) {
        const Dual reach = dot(out, corner(s, j) - corner(s, k));
        if (reach.value > beyond.value) beyond = reach;
      }
      weight = weight * within(from, out, beyond, n);
    }
    return weight;
  }

  Dual weigh(uint32_t t, const std::array<double, 3> &w, uint32_t s) const {
    const double reach = model_.valve.contact_thickness;
    const Dual3 p = w[0] * corner(t, 0) + w[1] * corner(t, 1) + w[2] * corner(t, 2);
    const Dual3 to = p - nearest(p, s), own = normal(t);
    const Dual distance = norm(to), share = (1 / reach) * distance;
    Dual weight = fall_of(share, distance_ramp) * fall_of(dot(own, normal(s)), normals_ramp);
    if (distance.value > contact_ramp.from * reach) {
      const Dual direction = fall_of(dot(to, own) / distance, direction_ramp);
      const Dual contact = fall_of(share, contact_ramp), one = constant(1);
      weight = weight * (one - (one - direction) * (one - contact));
    }
    return weight * within_borders(p, s);
  }

  const Model &model_;
  const std::vector<Vec3> &x_;
  std::vector<std::vector<BorderSide>> sides_of_;  // per node
  std::vector<uint32_t> nodes_;
};

void add_area(const Tri &t, const std::vector<Vec3> &x, const Vec3 &normal, double times,
              NodeField &g) {
  for (int k = 0; k < 3; ++k) {
    g[t[k]] += 0.5 * times * normal.cross(x[t[(k + 2) % 3]] - x[t[(k + 1) % 3]]);
  }
}

}  // namespace

double coaptation_area_gradient(const Model &model, const std::vector<Vec3> &x, NodeField &g) {
  const Surface surface = surface_of(model.valve.triangles, x);
  const FacingTree tree(model, x, surface);
  FacingWeight facing(model, x, surface, tree);
  SampleWeight sample(model, x);
  double total = 0;
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    if (!facing.begin(t)) continue;
    const Tri &c = model.valve.triangles[t];
    const size_t parts = coaptation_parts(model, t);
    const double share = 0.5 / static_cast<double>(parts * parts);
    FacingPoints centres;
    std::vector<std::array<double, 3>> places;
    for_each_part(parts, [&](const std::array<double, 3> &w) {
      places.push_back(w);
      centres.add(w[0] * x[c[0]] + w[1] * x[c[1]] + w[2] * x[c[2]]);
    });
    const FacingWeight::Best best = facing.best_of(centres);
    double sum = 0;
    for (size_t k = 0; k < places.size(); ++k) {
      sum += best.weight[k];
      if (best.weight[k] == 0 || best.weight[k] == 1) continue;  // the ramps are flat there
      sample.add_gradient(t, places[k], best.triangle[k], share * surface.area[t], g);
    }
    total += share * surface.area[t] * sum;
    add_area(c, x, surface.normal[t], share * sum, g);
  }
  return total;
}

}  // namespace mvs::core
