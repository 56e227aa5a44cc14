// Longest-edge bisection in rounds, each of which leaves a conforming mesh.
#include "measure/orifice/bisect.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace mvs::core::orifice {
namespace {

struct Edges {
  std::vector<Edge> ends;
  std::vector<Vec3> normal;
  std::vector<uint8_t> on_rim;
  std::vector<Tri> of_triangle;  // per triangle, side k joins corners k and k + 1
};

Vec3 area_vector(const Mesh &mesh, uint32_t t) {
  const Tri &c = mesh.triangles[t];
  return 0.5 * (mesh.x[c[1]] - mesh.x[c[0]]).cross(mesh.x[c[2]] - mesh.x[c[0]]);
}

struct NodeSide {
  uint32_t larger, triangle, k;
};

// Groups sides by their smaller node, so that each group can be sorted alone: this runs once in a
// round, and one sort of all sides would dominate its time. The sides of node n are sides[first[n]
// .. first[n + 1]).
std::vector<NodeSide> sides_by_node(const Mesh &mesh, std::vector<uint32_t> &first) {
  const auto smaller = [](const Tri &t, uint32_t k) { return std::min(t[k], t[(k + 1) % 3]); };
  first.assign(mesh.x.size() + 1, 0);
  for (const Tri &t : mesh.triangles) {
    for (uint32_t k = 0; k < 3; ++k) ++first[smaller(t, k) + 1];
  }
  for (size_t n = 0; n < mesh.x.size(); ++n) first[n + 1] += first[n];
  std::vector<NodeSide> sides(3 * mesh.triangles.size());
  std::vector<uint32_t> place(first.begin(), first.end() - 1);
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Tri &t = mesh.triangles[i];
    for (uint32_t k = 0; k < 3; ++k) {
      sides[place[smaller(t, k)]++] = {std::max(t[k], t[(k + 1) % 3]), i, k};
    }
  }
  return sides;
}

Edges edges_of(const Mesh &mesh) {
  std::vector<uint32_t> first;
  std::vector<NodeSide> sides = sides_by_node(mesh, first);
  Edges edges;
  edges.of_triangle.resize(mesh.triangles.size());
  for (uint32_t n = 0; n < mesh.x.size(); ++n) {
    const auto begin = sides.begin() + first[n], end = sides.begin() + first[n + 1];
    std::sort(begin, end, [](const NodeSide &l, const NodeSide &r) {
      return l.larger != r.larger ? l.larger < r.larger : l.triangle < r.triangle;
    });
    for (auto side = begin; side != end; ++side) {
      if (side == begin || side->larger != (side - 1)->larger) {
        edges.ends.push_back({n, side->larger});
        edges.normal.push_back(Vec3::Zero());
        edges.on_rim.push_back(1);
      } else {
        edges.on_rim.back() = 0;
      }
      edges.normal.back() += area_vector(mesh, side->triangle);
      edges.of_triangle[side->triangle][side->k] = static_cast<uint32_t>(edges.ends.size() - 1);
    }
  }
  return edges;
}

// Returns the side of triangle t that is divided first; among equal lengths, the one with the
// larger edge number.
uint32_t longest_side(const Mesh &mesh, const Edges &edges, uint32_t t) {
  const auto key = [&](uint32_t k) {
    const Edge &e = edges.ends[edges.of_triangle[t][k]];
    return std::pair((mesh.x[e[0]] - mesh.x[e[1]]).squaredNorm(), edges.of_triangle[t][k]);
  };
  uint32_t longest = 0;
  for (uint32_t k = 1; k < 3; ++k) {
    if (key(k) > key(longest)) longest = k;
  }
  return longest;
}

// Marks the longest edge of every triangle that has a marked edge, until nothing changes.
void mark_longest_sides(const Mesh &mesh, const Edges &edges, std::vector<uint8_t> &cut) {
  for (bool changed = true; changed;) {
    changed = false;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Tri &e = edges.of_triangle[t];
      if (!cut[e[0]] && !cut[e[1]] && !cut[e[2]]) continue;
      uint8_t &longest = cut[e[longest_side(mesh, edges, t)]];
      changed |= !longest;
      longest = 1;
    }
  }
}

// Appends the parts of triangle t; `middle` is the new node of each edge or `none`.
void cut_triangle(const Mesh &mesh, const Edges &edges, const std::vector<uint32_t> &middle,
                  uint32_t t, std::vector<Tri> &parts) {
  const uint32_t k = longest_side(mesh, edges, t), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
  const Tri &corner = mesh.triangles[t], &edge = edges.of_triangle[t];
  const uint32_t a = corner[k], b = corner[k1], c = corner[k2];
  const uint32_t ab = middle[edge[k]], bc = middle[edge[k1]], ca = middle[edge[k2]];
  if (ab == none) {
    parts.push_back(corner);
    return;
  }
  if (ca == none) {
    parts.push_back({a, ab, c});
  } else {
    parts.push_back({a, ab, ca});
    parts.push_back({ab, c, ca});
  }
  if (bc == none) {
    parts.push_back({ab, b, c});
  } else {
    parts.push_back({ab, b, bc});
    parts.push_back({ab, bc, c});
  }
}

}  // namespace

double area_of(const Mesh &mesh) {
  double area = 0;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) area += area_vector(mesh, t).norm();
  return area;
}

Mesh compact_mesh(const std::vector<Vec3> &points, const std::vector<Tri> &triangles) {
  Mesh mesh;
  std::vector<uint32_t> number(points.size(), none);
  for (Tri t : triangles) {
    for (uint32_t &v : t) {
      if (number[v] == none) {
        number[v] = static_cast<uint32_t>(mesh.x.size());
        mesh.x.push_back(points[v]);
      }
      v = number[v];
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

void bisect(Mesh &mesh, const std::function<bool(const BisectEdge &)> &is_too_long) {
  for (size_t known = 0;;) {
    const Edges edges = edges_of(mesh);
    std::vector<uint8_t> cut(edges.ends.size());
    for (size_t e = 0; e < cut.size(); ++e) {
      // an edge between nodes of earlier rounds was short enough then
      if (edges.ends[e][1] < known) continue;
      cut[e] = is_too_long({mesh.x[edges.ends[e][0]], mesh.x[edges.ends[e][1]], edges.normal[e],
                            edges.on_rim[e] != 0});
    }
    if (std::find(cut.begin(), cut.end(), 1) == cut.end()) return;
    known = mesh.x.size();
    mark_longest_sides(mesh, edges, cut);
    std::vector<uint32_t> middle(cut.size(), none);
    for (size_t e = 0; e < cut.size(); ++e) {
      if (!cut[e]) continue;
      middle[e] = static_cast<uint32_t>(mesh.x.size());
      mesh.x.push_back(0.5 * (mesh.x[edges.ends[e][0]] + mesh.x[edges.ends[e][1]]));
    }
    std::vector<Tri> parts;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      cut_triangle(mesh, edges, middle, t, parts);
    }
    mesh.triangles = std::move(parts);
  }
}

}  // namespace mvs::core::orifice
