// Triangles near each vertex, and a flood over the triangles around it. On fine meshes one query of
// a wider range decides for many vertices that they are clear.
#include "session/touching_tissue.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/triangle_bvh.h"
#include "model/compressed_rows.h"

namespace mvs::core {
namespace {

struct NearTriangle {
  uint32_t triangle;
  double distance2;  // m2
};

class Neighbourhoods {
 public:
  explicit Neighbourhoods(const Model &model)
      : x_(model.valve.rest.get()),
        triangles_(model.valve.triangles.get()),
        bvh_(triangles_, x_),
        stars_(model.topology.node_triangles),
        near_of_(triangles_.size(), 0),
        reached_from_(triangles_.size(), 0) {}

  bool is_tissue(uint32_t vertex) const { return !stars_[vertex].empty(); }

  // The triangles nearer than `reach` that are not joined to the vertex within `far`, which is
  // greater. Most vertices have near neighbours alone, which a first flood over the near triangles
  // finds.
  const std::vector<NearTriangle> &apart(uint32_t vertex, double reach, double far) {
    near_.clear();
    ++call_;
    const double reach2 = reach * reach, far2 = far * far;
    const Vec3 around = Vec3::Constant(reach);
    bvh_.for_overlapping({x_[vertex] - around, x_[vertex] + around}, [&](uint32_t t) {
      const double distance2 = bvh_.closest_on(t, x_[vertex]).distance2;
      if (distance2 >= reach2) return;
      near_.push_back({t, distance2});
      near_of_[t] = call_;
    });
    flood(vertex, [&](uint32_t t) { return near_of_[t] == call_; });
    drop_reached();
    if (near_.empty()) return near_;
    ++call_;
    flood(vertex, [&](uint32_t t) { return bvh_.closest_on(t, x_[vertex]).distance2 < far2; });
    drop_reached();
    return near_;
  }

  // Calls visit(vertex) for the vertices nearer than `reach` that the last flood has reached.
  template <typename Visit>
  void for_reached(uint32_t vertex, double reach, Visit &&visit) const {
    for (const uint32_t t : reached_) {
      for (const uint32_t corner : triangles_[t]) {
        if ((x_[corner] - x_[vertex]).squaredNorm() < reach * reach) visit(corner);
      }
    }
  }

 private:
  // Reaches the triangles that are joined to the vertex through triangles with passes(triangle).
  template <typename Passes>
  void flood(uint32_t vertex, Passes &&passes) {
    reached_.assign(stars_[vertex].begin(), stars_[vertex].end());
    for (const uint32_t t : reached_) reached_from_[t] = call_;
    for (size_t k = 0; k < reached_.size(); ++k) {
      for (const uint32_t corner : triangles_[reached_[k]]) {
        for (const uint32_t t : stars_[corner]) {
          if (reached_from_[t] == call_ || !passes(t)) continue;
          reached_from_[t] = call_;
          reached_.push_back(t);
        }
      }
    }
  }

  void drop_reached() {
    std::erase_if(near_, [&](const NearTriangle &t) { return reached_from_[t.triangle] == call_; });
  }

  const std::vector<Vec3> &x_;
  const std::vector<Tri> &triangles_;
  TriangleBvh bvh_;
  const Rows &stars_;
  std::vector<uint32_t> near_of_, reached_from_;  // of each triangle: the last call
  uint32_t call_ = 0;
  std::vector<uint32_t> reached_;
  std::vector<NearTriangle> near_;
};

}  // namespace

TouchingTissue find_touching_tissue(const Model &model) {
  const double thickness = model.valve.contact_thickness, far = joined_reach * thickness;
  Neighbourhoods neighbourhoods(model);
  TouchingTissue found;
  double least2 = INFINITY;
  // If a vertex is clear within `thickness + skip`, by ways within `far - skip`, those nearer to it
  // than `skip` are clear as well. Where sides are longer, there are hardly any.
  const double skip = mean_edge(model) < 0.5 * thickness ? thickness : 0;
  std::vector<uint8_t> is_clear(model.node_count(), 0);
  for (uint32_t v = 0; v < model.node_count(); ++v) {
    if (is_clear[v] != 0 || !neighbourhoods.is_tissue(v)) continue;
    if (skip > 0 && neighbourhoods.apart(v, thickness + skip, far - skip).empty()) {
      neighbourhoods.for_reached(v, skip, [&](uint32_t near) { is_clear[near] = 1; });
      continue;
    }
    const auto &apart = neighbourhoods.apart(v, thickness, far);
    found.vertices += !apart.empty();
    for (const auto &[triangle, distance2] : apart) {
      // of two as near, the first one, whatever the order of the hierarchy
      const bool is_first = found.vertex == v && triangle < found.triangle;
      if (distance2 > least2 || (distance2 == least2 && !is_first)) continue;
      least2 = distance2;
      found.vertex = v;
      found.triangle = triangle;
    }
  }
  found.distance = found.vertices > 0 ? std::sqrt(least2) : 0;
  return found;
}

}  // namespace mvs::core
