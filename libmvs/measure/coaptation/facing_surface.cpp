// Search of a triangle tree for the nearest triangle that a point faces.
#include "measure/coaptation/facing_surface.h"

#include <algorithm>
#include <cmath>

namespace mvs::core {
namespace {

constexpr double facing = -0.5;  // cosine between the normals
constexpr double ahead = 0.5;    // cosine between a normal and the direction to the partner
constexpr double straight_ahead = 0.966;  // 15 degrees: tolerance beyond a border
constexpr double touching = 0.1;          // share of reach below which the direction is not defined

std::vector<uint8_t> find_borders(const Model &model) {
  const Topology &topology = model.topology;
  std::vector<uint8_t> node_on_border(model.node_count(), 0);
  for (size_t e = 0; e < topology.edges.size(); ++e) {
    if (topology.edge_triangles[e][1] != none) continue;
    for (const uint32_t node : topology.edges[e]) node_on_border[node] = 1;
  }
  std::vector<uint8_t> border;
  border.reserve(model.valve.triangles.size());
  for (size_t t = 0; t < model.valve.triangles.size(); ++t) {
    unsigned bits = 0;
    for (unsigned k = 0; k < 3; ++k) {
      if (node_on_border[model.valve.triangles[t][k]]) bits |= 1u << k;
      if (topology.edge_triangles[topology.triangle_edges[t][k]][1] == none) bits |= 8u << k;
    }
    border.push_back(static_cast<uint8_t>(bits));
  }
  return border;
}

}  // namespace

FacingSurface::FacingSurface(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
                             const FacingTree &tree)
    : model_(model),
      x_(x),
      surface_(surface),
      tree_(tree),
      border_(find_borders(model)),
      reach_(model.valve.contact_thickness) {}

Partner FacingSurface::of_node(uint32_t node) const {
  return find(x_[node], surface_.node_normal[node], {node, node, node});
}

// Tissue of which only the border is near hides the tissue behind it: it lowers the limit but is
// not a partner.
Partner FacingSurface::find(const Vec3 &p, const Vec3 &normal, const Tri &own) const {
  Partner partner;
  double limit2 = reach_ * reach_;
  tree_.visit_near(p, normal, facing, limit2, [&](uint32_t t) {
    if (surface_.normal[t].dot(normal) > facing) return;
    if (tree_.box_of(t).distance2(p) > limit2) return;
    if (share_a_node(model_.valve.triangles[t], own)) return;
    const TrianglePoint q = tree_.closest_on(t, p);
    if (q.distance2 > limit2) return;
    const double distance = std::sqrt(q.distance2);
    const Vec3 to_partner = tree_.point_at(t, q.weight) - p;
    const bool far = distance > touching * reach_;
    if (far && to_partner.dot(normal) < ahead * distance) return;
    const bool at_border = (border_[t] >> q.feature & 1) != 0;
    const bool beyond =
        far && at_border && -to_partner.dot(surface_.normal[t]) < straight_ahead * distance;
    if (q.distance2 == limit2 && (beyond || t > partner.triangle)) return;
    limit2 = q.distance2;
    partner = beyond ? Partner() : Partner{t, distance};
  });
  return partner;
}

}  // namespace mvs::core
