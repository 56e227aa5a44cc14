// Matches that end at the free edge, by the vertex they end at, averaged over feet.
#include "patient/fit/edge_overhang.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/sides.h"
#include "patient/coordinates.h"

namespace mvs::core {
namespace {

constexpr double foot_window = 3e-3;     // m of the annulus, on both sides of a foot
constexpr double least_outwards = 0.5;   // between a match and the plane of the leaflet there
constexpr double at_vertex = 1e-6;       // weight of a corner that counts
constexpr double farthest_match = 6e-3;  // m: beyond, another part of the surface was met

// For each free-edge node: the area beyond it, m2, the length of the edge, m, the direction
// outwards.
struct EdgeNodes {
  std::vector<double> area, length;
  std::vector<Vec3> out;
};

// The edge in the closed shape; outwards is in the plane of the triangles at the edge.
EdgeNodes edge_nodes(const PatientGeometry &g, const std::vector<Vec3> &x) {
  const size_t n = g.sheet.x.size();
  EdgeNodes nodes{std::vector<double>(n, 0), std::vector<double>(n, 0),
                  std::vector<Vec3>(n, Vec3::Zero())};
  std::vector<uint32_t> next(n, none);
  const std::vector<uint32_t> &edge = g.rims.free_edge;
  for (size_t k = 0; k < edge.size(); ++k) next[edge[k]] = edge[(k + 1) % edge.size()];
  for (const Tri &t : g.sheet.triangles) {
    const Vec3 normal = area_normal(x, t).normalized();
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      if (next[a] != b && next[b] != a) continue;
      const Vec3 along = x[b] - x[a];
      for (const uint32_t i : {a, b}) {
        nodes.length[i] += 0.5 * along.norm();
        nodes.out[i] += along.cross(normal);
      }
    }
  }
  for (const uint32_t i : edge) nodes.out[i].normalize();
  return nodes;
}

// The corner of the match with the largest weight; none unless all that count are on the edge.
uint32_t edge_node_of(const SurfaceMatch &m, const EdgeNodes &nodes) {
  uint32_t nearest = none;
  double most = 0;
  for (size_t k = 0; k < 3; ++k) {
    if (m.weight[k] < at_vertex) continue;
    if (m.nodes[k] >= nodes.length.size() || nodes.length[m.nodes[k]] == 0) return none;
    if (m.weight[k] > most) {
      most = m.weight[k];
      nearest = m.nodes[k];
    }
  }
  return nearest;
}

}  // namespace

std::vector<double> edge_overhang(const PatientGeometry &g, const ClosedValve &closed,
                                  const std::vector<SurfaceMatch> &matches) {
  EdgeNodes nodes = edge_nodes(g, closed.state.x);
  for (const SurfaceMatch &m : matches) {
    const bool is_of_given = m.nodes[0] != m.nodes[1];
    if (!is_of_given || m.distance > farthest_match) continue;
    const uint32_t i = edge_node_of(m, nodes);
    // the match points from the given surface to the valve
    if (i == none || -m.direction.dot(nodes.out[i]) < least_outwards) continue;
    nodes.area[i] += m.area;
  }
  std::vector<double> overhang;
  for (const double foot : g.coordinates.foot) {
    double area = 0, length = 0;
    for (const uint32_t i : g.rims.free_edge) {
      const double far =
          around(foot, g.coordinates.foot[i], g.coordinates.annulus_length) / foot_window;
      if (far * far >= 1) continue;
      const double weight = (1 - far * far) * (1 - far * far);
      area += weight * nodes.area[i];
      length += weight * nodes.length[i];
    }
    overhang.push_back(length > 0 ? std::min(most_overhang, area / length) : 0);
  }
  return overhang;
}

}  // namespace mvs::core
