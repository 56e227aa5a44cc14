// Selects the free nodes, triangles and chordae of a local subproblem and builds its model.
#include "solve/static/local_subproblem.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

struct LocalBox {
  Vec3 low, high;
  bool near(const LocalBox &other, double distance) const {
    const Vec3 gap = (other.low - high).cwiseMax(low - other.high).cwiseMax(0.0);
    return gap.squaredNorm() <= distance * distance;
  }
};

LocalBox box_of(const std::vector<Vec3> &x, const Tri &t) {
  return {x[t[0]].cwiseMin(x[t[1]]).cwiseMin(x[t[2]]), x[t[0]].cwiseMax(x[t[1]]).cwiseMax(x[t[2]])};
}

LocalBox around(const LocalBox &a, const LocalBox &b) {
  return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
}

// Squared distance of each node from the nearest disturbed node. A disturbed branch point also
// disturbs the leaflet where its chordae end.
std::vector<double> distances2(const Model &whole, const std::vector<Vec3> &x,
                               std::vector<uint32_t> disturbed) {
  for (size_t k = 0, given = disturbed.size(); k < given; ++k) {
    for (const Chord &c : whole.valve.chords) {
      if (c.a == disturbed[k]) disturbed.push_back(c.b);
    }
  }
  std::vector<double> distance2(x.size(), HUGE_VAL);
  for (const uint32_t node : disturbed) {
    for (size_t i = 0; i < x.size(); ++i) {
      distance2[i] = std::min(distance2[i], (x[i] - x[node]).squaredNorm());
    }
  }
  return distance2;
}

std::vector<uint8_t> free_nodes(const Model &whole, const std::vector<Vec3> &x,
                                const std::vector<uint32_t> &disturbed, const LocalExtent &extent) {
  const std::vector<double> distance2 = distances2(whole, x, disturbed);
  double reach2 = extent.radius * extent.radius;
  if (extent.max_nodes < x.size()) {
    std::vector<double> sorted = distance2;
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(extent.max_nodes);
    std::nth_element(sorted.begin(), last, sorted.end());
    reach2 = std::min(reach2, *last);
  }
  std::vector<uint8_t> free(x.size(), 0);
  for (size_t i = 0; i < x.size(); ++i) free[i] = distance2[i] <= reach2;
  // a branch point is free where a node of its chordae is
  for (const Chord &c : whole.valve.chords) free[c.a] |= free[c.b];
  for (size_t i = 0; i < x.size(); ++i) free[i] &= !whole.topology.fixed[i];
  return free;
}

// Boxes in groups, so that most of them need no test of their own.
class LocalBoxes {
 public:
  void add(const LocalBox &box) {
    if (boxes_.size() % group == 0) {
      around_.push_back(box);
    } else {
      around_.back() = around(around_.back(), box);
    }
    boxes_.push_back(box);
  }
  bool any_near(const LocalBox &box, double distance) const {
    for (size_t g = 0; g < around_.size(); ++g) {
      if (!around_[g].near(box, distance)) continue;
      const size_t first = group * g, last = std::min(first + group, boxes_.size());
      for (size_t k = first; k < last; ++k) {
        if (boxes_[k].near(box, distance)) return true;
      }
    }
    return false;
  }

 private:
  static constexpr size_t group = 8;
  std::vector<LocalBox> boxes_, around_;
};

// Triangles with a free corner, and the triangles that these could meet.
std::vector<uint8_t> included_triangles(const Model &whole, const std::vector<Vec3> &x,
                                        const std::vector<uint8_t> &free, double distance) {
  const auto &triangles = whole.valve.triangles.get();
  std::vector<uint8_t> included(triangles.size(), 0);
  LocalBoxes moving;
  for (size_t t = 0; t < triangles.size(); ++t) {
    const Tri &tri = triangles[t];
    if (!free[tri[0]] && !free[tri[1]] && !free[tri[2]]) continue;
    included[t] = 1;
    moving.add(box_of(x, tri));
  }
  for (size_t t = 0; t < triangles.size(); ++t) {
    if (!included[t]) included[t] = moving.any_near(box_of(x, triangles[t]), distance);
  }
  return included;
}

// The nodes of the subproblem, in the order of the whole valve.
struct LocalNumbering {
  std::vector<uint32_t> of;    // node of the whole -> of the subproblem, or none
  std::vector<uint32_t> node;  // and back
};

LocalNumbering number_locally(const Model &whole, const std::vector<uint8_t> &free,
                              const std::vector<uint8_t> &included) {
  std::vector<uint8_t> in(whole.node_count(), 0);
  for (size_t t = 0; t < included.size(); ++t) {
    for (const uint32_t i : whole.valve.triangles[t]) in[i] |= included[t];
  }
  for (const Chord &c : whole.valve.chords) {
    if (free[c.a] || free[c.b]) in[c.a] = in[c.b] = 1;
  }
  LocalNumbering index{std::vector<uint32_t>(in.size(), none), {}};
  for (uint32_t i = 0; i < in.size(); ++i) {
    if (!in[i]) continue;
    index.of[i] = static_cast<uint32_t>(index.node.size());
    index.node.push_back(i);
  }
  return index;
}

void copy_material(const Valve &from, Valve &to) {
  to.leaflets = from.leaflets;
  to.curves = from.curves;
  to.contact_thickness = from.contact_thickness;
  to.contact_stiffness = from.contact_stiffness;
  to.bending_scale = from.bending_scale;
}

void add_triangles(const Model &whole, const std::vector<uint8_t> &included,
                   const LocalNumbering &index, Model &local) {
  const Valve &valve = whole.valve;
  for (uint32_t t = 0; t < included.size(); ++t) {
    if (!included[t]) continue;
    const Tri &tri = valve.triangles[t];
    local.valve.triangles.push_back({index.of[tri[0]], index.of[tri[1]], index.of[tri[2]]});
    local.valve.triangle_leaflet.push_back(valve.triangle_leaflet[t]);
    local.valve.triangle_thickness.push_back(valve.triangle_thickness[t]);
    local.valve.triangle_fibre.push_back(valve.triangle_fibre[t]);
    local.rest_area.push_back(whole.rest_area[t]);
  }
}

}  // namespace

LocalSubproblem make_local_subproblem(const Model &whole, const std::vector<Vec3> &x,
                                      const std::vector<uint32_t> &disturbed,
                                      const LocalExtent &extent) {
  const std::vector<uint8_t> free = free_nodes(whole, x, disturbed, extent);
  // contact acts within one thickness; the half thickness more is for edges that reach farther
  const double distance = extent.max_displacement + 1.5 * whole.valve.contact_thickness;
  const std::vector<uint8_t> included = included_triangles(whole, x, free, distance);
  const LocalNumbering index = number_locally(whole, free, included);
  LocalSubproblem region{{}, index.node};
  Model &local = region.model;
  copy_material(whole.valve, local.valve);
  add_triangles(whole, included, index, local);
  for (const uint32_t i : index.node) {
    local.valve.rest.push_back(whole.valve.rest[i]);
    local.valve.open.push_back(x[i]);
    local.vertex_area.push_back(whole.vertex_area[i]);
  }
  local.valve.loaded = local.valve.open;
  for (Chord c : whole.valve.chords) {
    if (!free[c.a] && !free[c.b]) continue;
    c.a = index.of[c.a];
    c.b = index.of[c.b];
    local.valve.chords.push_back(c);
  }
  local.topology = make_topology(local.valve);
  for (uint32_t k = 0; k < index.node.size(); ++k) {
    local.topology.fixed[k] = !free[index.node[k]];
  }
  const auto &rest = local.valve.rest.get();
  for (const Edge &e : local.topology.edges) {
    local.rest_length.push_back((rest[e[1]] - rest[e[0]]).norm());
  }
  return region;
}

}  // namespace mvs::core
