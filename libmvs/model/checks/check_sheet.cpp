// Checks the triangles one by one, then the sheet that they form: manifold, oriented, attached,
// facing the atrium.
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "model/checks/checks.h"
#include "model/compressed_rows.h"
#include "model/orientation.h"

namespace mvs::core {
namespace {

std::string triangle_part(size_t t) {
  return format("triangle %zu", t);
}
std::string edge_part(const Edge &edge) {
  return format("edge %u-%u", edge[0], edge[1]);
}

// Ratio of height to longest side below which a triangle counts as degenerate.
constexpr double flat_triangle = 1e-6;

bool repeats_a_corner(const Tri &t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void check_triangle(const Valve &valve, size_t t, Faults &faults) {
  const Tri &nodes = valve.triangles[t];
  if (repeats_a_corner(nodes)) {
    faults.add(triangle_part(t), "triangle %zu names a node twice (%u, %u, %u): remove it", t,
               nodes[0], nodes[1], nodes[2]);
    return;
  }
  const Vec3 a = valve.rest[nodes[1]] - valve.rest[nodes[0]];
  const Vec3 b = valve.rest[nodes[2]] - valve.rest[nodes[0]];
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
  if (!(a.cross(b).norm() > flat_triangle * longest)) {
    faults.add(triangle_part(t), "triangle %zu has no area: remove it or move one of its nodes", t);
  }
  if (!valve.scallops.empty()) {
    const Scallop &scallop = valve.scallops[valve.triangle_scallop[t]];
    if (scallop.leaflet != valve.triangle_leaflet[t]) {
      faults.add(triangle_part(t), "triangle %zu lies in leaflet %s, but its scallop %s does not",
                 t, valve.leaflets[valve.triangle_leaflet[t]].name.c_str(), scallop.name.c_str());
    }
  }
}

void check_fibre(const Valve &valve, size_t t, Faults &faults) {
  const Vec3 &fibre = valve.triangle_fibre[t], &p = valve.rest[valve.triangles[t][0]];
  const Vec3 normal = (valve.rest[valve.triangles[t][1]] - p)
                          .cross(valve.rest[valve.triangles[t][2]] - p)
                          .normalized();
  const Vec3 flat = fibre - fibre.dot(normal) * normal;
  if (!(flat.norm() > 1e-6 * fibre.norm()) || !fibre.allFinite()) {
    faults.add(triangle_part(t), "triangle %zu has no fibre direction in its plane", t);
  }
}

void check_duplicate_triangles(const Valve &valve, Faults &faults) {
  std::vector<uint32_t> order(valve.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<Tri> sorted = valve.triangles;
  for (Tri &triangle : sorted) std::sort(triangle.begin(), triangle.end());
  std::sort(order.begin(), order.end(), [&](uint32_t l, uint32_t r) {
    return sorted[l] != sorted[r] ? sorted[l] < sorted[r] : l < r;
  });
  for (size_t k = 1; k < order.size(); ++k) {
    if (sorted[order[k]] != sorted[order[k - 1]]) continue;
    faults.add(triangle_part(order[k]), "triangle %u has the same nodes as triangle %u: remove it",
               order[k], order[k - 1]);
  }
}

// Reports coincident vertices: an unwelded seam, at which the sheet would tear. Sweep along one
// direction.
void check_coincident(const Valve &valve, const Sheet &sheet, Faults &faults) {
  const Vec3 direction(0.3826834323650898, 0.5773502691896258, 0.7211102550927978);  // generic
  std::vector<std::pair<double, uint32_t>> order;
  for (uint32_t n = 0; n < valve.rest.size(); ++n) {
    if (sheet.is_vertex[n]) order.emplace_back(direction.dot(valve.rest[n]), n);
  }
  std::sort(order.begin(), order.end());
  constexpr double same_place = 1e-8;  // m: a hundredth of a red blood cell
  for (size_t i = 0; i < order.size(); ++i) {
    for (size_t j = i + 1; j < order.size(); ++j) {
      if (order[j].first - order[i].first > 1.01 * same_place) break;
      const uint32_t a = std::min(order[i].second, order[j].second);
      const uint32_t b = std::max(order[i].second, order[j].second);
      if ((valve.rest[a] - valve.rest[b]).norm() > same_place) continue;
      faults.add(format("node %u", b), "nodes %u and %u lie at the same place: make them one", a,
                 b);
    }
  }
}

// Reports edges with more than two triangles; returns whether there are any.
bool check_edges(const Sheet &sheet, Faults &faults) {
  bool branches = false;
  for_each_edge(sheet.sides, [&](size_t first, size_t last) {
    if (last - first <= 2) return;
    branches = true;
    const Edge &edge = sheet.sides[first].edge;
    faults.add(edge_part(edge),
               "edge %u-%u joins %zu triangles: a sheet has one or two at each edge", edge[0],
               edge[1], last - first);
  });
  return branches;
}

// Returns whether the triangles around a node form one fan: the edges opposite to the node are
// connected (union-find).
bool is_one_fan(const Valve &valve, uint32_t node, std::span<const uint32_t> around) {
  std::vector<Edge> link;
  std::vector<uint32_t> corners;
  for (const uint32_t t : around) {
    const Tri &nodes = valve.triangles[t];
    const int k = nodes[0] == node ? 0 : nodes[1] == node ? 1 : 2;
    link.push_back({nodes[(k + 1) % 3], nodes[(k + 2) % 3]});
    corners.insert(corners.end(), link.back().begin(), link.back().end());
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<uint32_t> root(corners.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](uint32_t corner) {
    auto r = static_cast<uint32_t>(std::lower_bound(corners.begin(), corners.end(), corner) -
                                   corners.begin());
    while (root[r] != r) r = root[r] = root[root[r]];
    return r;
  };
  size_t parts = corners.size();
  for (const Edge &edge : link) {
    const uint32_t a = find(edge[0]), b = find(edge[1]);
    root[std::max(a, b)] = std::min(a, b);
    parts -= a != b;
  }
  return parts == 1;
}

void check_vertices(const Valve &valve, Faults &faults) {
  const Rows around = rows_of(valve.rest.size(), valve.triangles.get());
  for (uint32_t n = 0; n < valve.rest.size(); ++n) {
    if (around[n].empty() || is_one_fan(valve, n, around[n])) continue;
    faults.add(format("node %u", n),
               "node %u is where two parts of the sheet touch in one point only: join them along "
               "an edge or give each its own node",
               n);
  }
}

// Reports the triangles with the less frequent winding in each component: most likely those are
// wrong.
void check_winding(const Sheet &sheet, Faults &faults) {
  const Winding &winding = sheet.winding;
  for (const Edge &edge : winding.conflicts) {
    faults.add(edge_part(edge), "at edge %u-%u the sheet has no two sides, like a Moebius strip",
               edge[0], edge[1]);
  }
  if (!winding.conflicts.empty()) return;
  std::vector<size_t> size(winding.component_count, 0), against(winding.component_count, 0);
  for (size_t t = 0; t < winding.component.size(); ++t) {
    ++size[winding.component[t]];
    against[winding.component[t]] += winding.against[t];
  }
  for (size_t t = 0; t < winding.component.size(); ++t) {
    const uint32_t c = winding.component[t];
    const uint8_t odd = 2 * against[c] <= size[c] ? 1 : 0;
    if (against[c] == 0 || winding.against[t] != odd) continue;
    faults.add(triangle_part(t),
               "triangle %zu is wound against its neighbours: swap two of its nodes, or set "
               "MVS_VALVE_FLAG_ORIENT (Python: orient=True)",
               t);
  }
}

void check_components(const Valve &valve, const Sheet &sheet, Faults &faults) {
  const std::vector<uint8_t> in_annulus = marks_of(valve.annulus, valve.rest.size());
  const std::vector<uint32_t> &component = sheet.winding.component;
  std::vector<uint8_t> touches(sheet.winding.component_count, 0);
  std::vector<size_t> size(touches.size(), 0), first(touches.size(), 0);
  for (size_t t = component.size(); t-- > 0;) {
    ++size[component[t]];
    first[component[t]] = t;
    for (const uint32_t node : valve.triangles[t]) touches[component[t]] |= in_annulus[node];
  }
  for (size_t c = 0; c < touches.size(); ++c) {
    if (touches[c]) continue;
    faults.add(triangle_part(first[c]),
               "the part of the sheet with triangle %zu (%zu triangles) is not attached: join it "
               "to the leaflets, or remove it",
               first[c], size[c]);
  }
}

void check_facing(const Valve &valve, const Sheet &sheet, Faults &faults) {
  const AtrialSide atrium = atrial_side(valve);
  const std::vector<Vec3> areas = faced_areas(valve, sheet.sides, sheet.winding);
  for (size_t c = 0; c < areas.size(); ++c) {
    if (areas[c].dot(atrium.axis) >= 0) continue;
    faults.add("sheet",
               "the sheet faces the ventricle: swap two nodes of every triangle so that normals "
               "point into the atrium, or set MVS_VALVE_FLAG_ORIENT (Python: orient=True)");
  }
}

}  // namespace

void check_sheet(const Valve &valve, const Sheet &sheet, Faults &faults) {
  const size_t before = faults.list.size();
  for (size_t t = 0; t < valve.triangles.size(); ++t) check_triangle(valve, t, faults);
  check_duplicate_triangles(valve, faults);
  check_coincident(valve, sheet, faults);
  if (faults.list.size() > before) return;
  for (size_t t = 0; t < valve.triangle_fibre.size(); ++t) check_fibre(valve, t, faults);
  if (check_edges(sheet, faults)) return;
  check_vertices(valve, faults);
  check_components(valve, sheet, faults);
  const size_t unwound = faults.list.size();
  check_winding(sheet, faults);
  if (faults.list.size() == unwound) check_facing(valve, sheet, faults);
}

}  // namespace mvs::core
