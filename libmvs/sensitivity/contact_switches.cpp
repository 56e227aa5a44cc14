// Switches of contact. The energy of a vertex is a sum over triangles, edges and corners near it,
// each with a distance to a convex set (energy/contact.h): d is C1 and its second derivative jumps
// where the closest point passes to a smaller feature. With r = sum w_i x_i the vector between the
// closest points and t = sum slide_i x_i the direction that the smaller feature no longer follows,
// square to the one that it still does, that surface is u = r . t / |t| = 0, and beyond it
//     E(d + u^2 / 2 d) - E(d) = 1/2 E'/d u^2:   k = E' / d,   grad_i u = (w_i t + slide_i r) / |t|.
#include <cmath>

#include "collision/instrument_bodies.h"
#include "energy/barrier.h"
#include "energy/contact.h"
#include "geometry/distance.h"
#include "model/tool.h"
#include "sensitivity/switches.h"

namespace mvs::core {
namespace {

// Energy strength * range * B((d - radius) / range) of a pair.
struct Law {
  double strength, range, radius;
};

class ContactSwitches {
 public:
  ContactSwitches(const Model &model, const std::vector<Vec3> &x, double slack,
                  std::vector<Switch> &to)
      : model_(model), x_(x), slack_(slack), to_(to), is_on_rim_(model.node_count(), 0) {
    for (size_t e = 0; e < model.topology.edges.size(); ++e) {
      if (!is_rim(static_cast<uint32_t>(e))) continue;
      for (const uint32_t i : model.topology.edges[e]) is_on_rim_[i] = 1;
    }
  }

  void add_vertex(const VertexTriangle *first, const VertexTriangle *last);
  void add_triangle(uint32_t v, const Tri &t, const Law &law);
  void add_segment(uint32_t v, uint32_t a, uint32_t b, const Law &law);
  void add_point(uint32_t v, uint32_t a, const Law &law) { add_begin(point_point(v, a), law); }
  void add_edges(const Edge &e, const Edge &f, const Law &law) {
    add_begin(edge_edge(e, f, closest_of_segments(x_[e[0]], x_[e[1]], x_[f[0]], x_[f[1]])), law);
    add_ends(e, f, law);
    add_ends(f, e, law);
  }

 private:
  void add_ends(const Edge &e, const Edge &f, const Law &law);
  bool is_rim(uint32_t e) const { return model_.topology.edge_triangles[e][1] == none; }
  // True if the pair is within its range or about to be.
  bool is_near(ContactPair &pair, const Law &law) const {
    pair.range = law.range + slack_;
    pair.radius = law.radius;
    return measure(x_, pair);
  }
  void add_begin(ContactPair pair, const Law &law);
  void add_leave(ContactPair wide, double coordinate, const Law &law);
  void add_or_merge(Switch s);

  const Model &model_;
  const std::vector<Vec3> &x_;
  double slack_;
  std::vector<Switch> &to_;
  std::vector<uint8_t> is_on_rim_;  // corners that count 0
};

// Contact that begins: u is the depth within the range.
void ContactSwitches::add_begin(ContactPair pair, const Law &law) {
  if (!is_near(pair, law)) return;
  const double depth = law.range - pair.gap();
  if (std::abs(depth) > slack_) return;
  Switch s;
  s.kind = SwitchKind::contact;
  s.index = pair.node[0];
  for (uint32_t k = 0; k < pair.count; ++k) {
    s.gradient.push_back({pair.node[k], -pair.weight[k] * pair.normal});
  }
  s.over = depth;
  s.strength = law.strength;
  s.range = law.range;
  to_.push_back(std::move(s));
}

// The closest point leaves `wide` for the smaller feature without its first slide. `coordinate` is
// that along the slide: 0 at the surface, negative beyond it, where the tangent has the smaller
// feature.
void ContactSwitches::add_leave(ContactPair wide, double coordinate, const Law &law) {
  if (!is_near(wide, law) || wide.gap() >= law.range) return;
  std::array<Vec3, 2> t{Vec3::Zero(), Vec3::Zero()};
  for (uint32_t a = 0; a < wide.slides; ++a) {
    for (uint32_t k = 0; k < wide.count; ++k) t[a] += wide.slide[a][k] * x_[wide.node[k]];
  }
  const double share = wide.slides == 2 ? t[0].dot(t[1]) / t[1].squaredNorm() : 0;
  const Vec3 across = t[0] - share * t[1];
  const double size = across.norm();
  if (!(size > 0) || std::abs(coordinate) * size > slack_) return;
  Switch s;
  s.kind = SwitchKind::contact;
  s.index = wide.node[0];
  const Vec3 r = wide.distance * wide.normal;
  for (uint32_t k = 0; k < wide.count; ++k) {
    const double slide = wide.slide[0][k] - share * wide.slide[1][k];
    s.gradient.push_back({wide.node[k], (wide.weight[k] * across + slide * r) / size});
  }
  s.over = -coordinate * size;
  const double jump = law.strength * barrier(wide.gap() / law.range).first / wide.distance;
  (s.over > 0 ? s.down : s.up) = s.over > 0 ? -jump : jump;
  add_or_merge(std::move(s));
}

// Triangles of one edge, and the edge itself, switch to its corner at the same surface.
void ContactSwitches::add_or_merge(Switch s) {
  const auto is_same = [&](const Switch &other) {
    if (other.begins() || other.gradient.size() != s.gradient.size()) return false;
    for (size_t k = 0; k < s.gradient.size(); ++k) {
      if (other.gradient[k].node != s.gradient[k].node) return false;
      if ((other.gradient[k].value - s.gradient[k].value).norm() > 1e-9) return false;
    }
    return true;
  };
  for (size_t k = to_.size(); k-- > 0 && to_[k].index == s.index;) {
    if (to_[k].kind != SwitchKind::contact || !is_same(to_[k])) continue;
    to_[k].up += s.up;
    to_[k].down += s.down;
    return;
  }
  to_.push_back(std::move(s));
}

// Both ends of a segment.
void ContactSwitches::add_segment(uint32_t v, uint32_t a, uint32_t b, const Law &law) {
  const Vec3 ab = x_[b] - x_[a];
  const double s = (x_[v] - x_[a]).dot(ab) / ab.squaredNorm();
  add_leave(point_edge(v, a, b, s), s, law);
  add_leave(point_edge(v, b, a, 1 - s), 1 - s, law);
  if (s > 0 && s < 1) {
    add_begin(point_edge(v, a, b, s), law);
  } else {
    add_begin(point_point(v, s > 0 ? b : a), law);
  }
}

// The edges of a triangle, seen from its inside or from beyond them, and their ends.
void ContactSwitches::add_triangle(uint32_t v, const Tri &t, const Law &law) {
  const TrianglePoint p = closest_on_triangle(x_[v], x_[t[0]], x_[t[1]], x_[t[2]]);
  const double reach = law.range + slack_;
  if (p.distance2 >= reach * reach) return;
  add_begin(vertex_triangle(v, t, p), law);
  const Vec3 ab = x_[t[1]] - x_[t[0]], ac = x_[t[2]] - x_[t[0]], ap = x_[v] - x_[t[0]];
  const Vec3 twice = ab.cross(ac);
  const double v1 = ap.cross(ac).dot(twice) / twice.squaredNorm();
  const double v2 = ab.cross(ap).dot(twice) / twice.squaredNorm();
  const std::array<double, 3> w = {1 - v1 - v2, v1, v2};  // of the foot in the plane
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t l = (k + 1) % 3, m = (k + 2) % 3;
    // from the inside over the edge opposite to k
    if (p.feature == 6 || p.feature == 3 + l) {
      add_leave(point_face(v, {t[l], t[k], t[m]}, {w[l], w[k], w[m]}), w[k], law);
    }
    // along the edge from k to l
    if (p.feature != 3 + k && p.feature != k && p.feature != l) continue;
    const Vec3 kl = x_[t[l]] - x_[t[k]];
    const double s = (x_[v] - x_[t[k]]).dot(kl) / kl.squaredNorm();
    if (p.feature != l) add_leave(point_edge(v, t[k], t[l], s), s, law);
    if (p.feature != k) add_leave(point_edge(v, t[l], t[k], 1 - s), 1 - s, law);
  }
}

// Contact proper of one vertex, as ContactTerm counts it: each triangle, edge and corner once.
void ContactSwitches::add_vertex(const VertexTriangle *first, const VertexTriangle *last) {
  const Valve &valve = model_.valve;
  const Topology &topology = model_.topology;
  const uint32_t v = first->vertex;
  const Law law = {vertex_strength(model_, v), valve.contact_thickness, 0};
  const Law subtracted = {-law.strength, law.range, 0};
  std::vector<uint32_t> edges, corners;
  const auto is_new = [](std::vector<uint32_t> &list, uint32_t item) {
    for (const uint32_t other : list) {
      if (other == item) return false;
    }
    list.push_back(item);
    return true;
  };
  for (const VertexTriangle *c = first; c != last; ++c) {
    const Tri &t = valve.triangles[c->triangle];
    add_triangle(v, t, law);
    for (const uint32_t e : topology.triangle_edges[c->triangle]) is_new(edges, e);
    for (const uint32_t k : t) is_new(corners, k);
  }
  for (const uint32_t e : edges) {
    if (!is_rim(e)) add_segment(v, topology.edges[e][0], topology.edges[e][1], subtracted);
  }
  for (const uint32_t k : corners) {
    if (!is_on_rim_[k]) add_point(v, k, law);
  }
}

// The ends of an edge of the short-range barrier, seen from another edge.
void ContactSwitches::add_ends(const Edge &e, const Edge &f, const Law &law) {
  const Vec3 d = x_[e[1]] - x_[e[0]], g = x_[f[1]] - x_[f[0]], r = x_[e[0]] - x_[f[0]];
  const SegmentPair p = closest_of_segments(x_[e[0]], x_[e[1]], x_[f[0]], x_[f[1]]);
  const double reach = law.range + slack_;
  if (p.distance2 >= reach * reach) return;
  // the closest point of the first edge, with the second one free or held where it ends
  const double dd = d.squaredNorm(), gg = g.squaredNorm(), dg = d.dot(g);
  const bool holds = p.t <= 0 || p.t >= 1;
  const double determinant = dd * gg - dg * dg;
  double s = 0;
  if (holds) {
    s = -(r - p.t * g).dot(d) / dd;
  } else {
    if (!(determinant > 1e-12 * dd * gg)) return;  // parallel
    s = (dg * g.dot(r) - gg * d.dot(r)) / determinant;
  }
  const double t = holds ? p.t : (dg * s + g.dot(r)) / gg;
  ContactPair wide = edge_edge(e, f, p);
  wide.weight = {1 - s, s, t - 1, -t};
  wide.slides = 1;
  wide.slide[0] = {-1, 1, 0, 0};
  if (!holds) wide.slide[wide.slides++] = {0, 0, 1, -1};
  add_leave(wide, s, law);
  wide.slide[0] = {1, -1, 0, 0};
  add_leave(wide, 1 - s, law);
}

void add_instruments(const Model &model, const std::vector<InstrumentBody> &bodies,
                     ContactSwitches &switches) {
  for (const InstrumentBody &body : bodies) {
    for (const uint32_t v : body.vertices) {
      const Law law = {model.valve.contact_stiffness * model.vertex_area[v], tool_range(model),
                       body.tool.radius};
      if (body.is_rod()) {
        switches.add_segment(v, body.point[0], body.point[1], law);
      } else {
        switches.add_point(v, body.point[0], law);
      }
    }
  }
}

}  // namespace

void find_contact_switches(const Model &model, const std::vector<Vec3> &x, double slack,
                           TotalEnergy &energy, std::vector<Switch> &to) {
  ContactSwitches switches(model, x, slack, to);
  const BroadPhase &near = energy.broad_phase();
  const std::vector<VertexTriangle> &contact = near.contact_candidates();
  for (size_t first = 0, last = 0; first < contact.size(); first = last) {
    while (last < contact.size() && contact[last].vertex == contact[first].vertex) ++last;
    switches.add_vertex(contact.data() + first, contact.data() + last);
  }
  const Valve &valve = model.valve;
  for (const VertexTriangle &pair : near.barrier_candidates()) {
    switches.add_triangle(pair.vertex, valve.triangles[pair.triangle],
                          {vertex_strength(model, pair.vertex), pair.range, 0});
  }
  const Topology &topology = model.topology;
  for (const EdgeEdge &pair : near.barrier_edge_candidates()) {
    const Edge &e = topology.edges[pair.first], &f = topology.edges[pair.second];
    const Law law = {
        edge_strength(model, edge_area(model, pair.first), edge_area(model, pair.second)),
        pair.range, 0};
    switches.add_edges(e, f, law);
  }
  add_instruments(model, energy.instrument().bodies().all(), switches);
}

}  // namespace mvs::core
