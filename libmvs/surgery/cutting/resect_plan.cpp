// Cut lines of resections on the flattened leaflet, from numbers or from an outline.
#include "surgery/cutting/resect_plan.h"

#include <algorithm>

#include "base/error.h"
#include "geometry/distance.h"
#include "surgery/leaflet/flat_edge.h"

namespace mvs::core {
namespace {

// Width of tissue that remains between a cut and the annulus for the stitches: one thickness of the
// leaflet, m.
double least_rim(const Surgery &s) {
  return s.valve.contact_thickness;
}

// Returns the length of the free edge of a scallop at rest.
double free_edge_of(const Surgery &s, uint32_t scallop) {
  const Topology &topology = s.before.topology;
  std::vector<uint8_t> is_free(s.valve.rest.size(), 0);
  for (const auto &loop : topology.free_edges) {
    for (const uint32_t n : loop) is_free[n] = 1;
  }
  double length = 0;
  for (size_t e = 0; e < topology.edges.size(); ++e) {
    const auto [t, u] = topology.edge_triangles[e];
    const Edge &edge = topology.edges[e];
    if (u != none || s.before.valve.triangle_scallop[t] != scallop) continue;
    if (is_free[edge[0]] && is_free[edge[1]]) length += s.before.rest_length[e];
  }
  return length;
}

const char *name_of(const Surgery &s, uint32_t scallop) {
  return s.before.valve.scallops[scallop].name.c_str();
}

SheetPoint on_scallop(const Surgery &s, uint32_t scallop, double along, double height) {
  return locate(s,
                {MVS_SITE_ANATOMICAL, 0, s.valve.scallops.get()[scallop].id, {along, height, 0}});
}

// The shape on one scallop that the numbers of the operation define.
struct Shape {
  double width, base, depth;
  Vec2 edge, up;  // the middle of the free edge; from there out of the leaflet
};

void check_shape(const Surgery &s, uint32_t scallop, const Shape &shape, double height) {
  const char *name = name_of(s, scallop);
  const double edge = free_edge_of(s, scallop), deepest = height - least_rim(s);
  MVS_MUST(shape.width <= edge, MVS_E_OP, "resect.width",
           "resect: width is %.1f mm, but the free edge of %s is %.1f mm long: take less",
           1e3 * shape.width, name, 1e3 * edge);
  MVS_MUST(
      shape.base <= shape.width, MVS_E_OP, "resect.base_width",
      "resect: base_width is %.1f mm, wider than the %.1f mm at the free edge: the sides could "
      "not be sewn together",
      1e3 * shape.base, 1e3 * shape.width);
  MVS_MUST(shape.depth <= deepest, MVS_E_OP, "resect.depth",
           "resect: depth is %.1f mm, but %s is %.1f mm high there: take at most %.1f mm, so that "
           "the cut does not reach the annulus",
           1e3 * shape.depth, name, 1e3 * height, 1e3 * deepest);
}

ResectPlan plan_shape(const Surgery &s, const mvs_op_resect &op) {
  ResectPlan plan;
  plan.scallop = scallop_or(s, op.scallop, "P2");
  const double along = 0.5 * (op.position + 1);
  const SheetPoint edge = on_scallop(s, plan.scallop, along, 1);
  const SheetPoint base = on_scallop(s, plan.scallop, along, 0);
  const Valve &valve = s.before.valve;
  plan.flat = flatten(s.before, edge.triangle);
  const auto stretches = free_edges_on(s, plan.flat);
  const Along middle = nearest_along(stretches, plan.flat.point(valve, edge));
  Shape shape{op.width != 0 ? op.width : 8e-3, op.base_width, op.depth, Vec2::Zero(), Vec2::Zero()};
  MVS_MUST(middle.stretch && walk(middle, 0, shape.edge) && plan.flat.has(valve, base.triangle),
           MVS_E_OP, "scallop", "resect: %s has no free edge across from the annulus to cut from",
           name_of(s, plan.scallop));
  const Vec2 foot = plan.flat.point(valve, base);
  const double height = (shape.edge - foot).norm();
  shape.up = (shape.edge - foot) / height;
  if (shape.depth == 0) shape.depth = 0.8 * height;
  check_shape(s, plan.scallop, shape, height);
  Vec2 first, last;
  MVS_MUST(
      walk(middle, -0.5 * shape.width, first) && walk(middle, 0.5 * shape.width, last), MVS_E_OP,
      "resect.position",
      "resect: %.1f mm around this position reach past the leaflet of %s: take less, or a position "
      "nearer to its middle",
      1e3 * shape.width, name_of(s, plan.scallop));
  const Vec2 deep = shape.edge - shape.depth * shape.up;
  const Vec2 across = turned(shape.up) * ((first - last).dot(turned(shape.up)) > 0 ? 1 : -1);
  plan.line = {first, deep + 0.5 * shape.base * across, deep - 0.5 * shape.base * across, last};
  if (shape.base == 0) plan.line.erase(plan.line.begin() + 2);
  plan.depth = shape.depth;
  for (int k = 0; k < 3; ++k) {
    plan.annulus += base.weight[k] * valve.rest[valve.triangles[base.triangle][k]];
  }
  return plan;
}

// Returns the nearest point on the accepted triangles of the present leaflets, and its distance.
template <typename Taken>
SheetPoint nearest(const Surgery &s, const Vec3 &p, Taken taken, double &distance) {
  SheetPoint best;
  double least = 1e300;
  const std::vector<Vec3> &x = s.state.x;
  for (uint32_t t = 0; t < s.before.valve.triangles.size(); ++t) {
    if (!taken(t)) continue;
    const Tri &tri = s.before.valve.triangles[t];
    const TrianglePoint at = closest_on_triangle(p, x[tri[0]], x[tri[1]], x[tri[2]]);
    if (at.distance2 >= least) continue;
    least = at.distance2;
    best = {t, at.weight};
  }
  distance = std::sqrt(least);
  return best;
}

// Returns the leaflet of an outline: the nearest one in the sum over all points. Closed leaflets
// lie so close that single points may be nearer to the other one.
uint32_t leaflet_of(const Surgery &s, const std::vector<Vec3> &points) {
  uint32_t best = 0;
  double least = 1e300;
  for (uint32_t l = 0; l < s.before.valve.leaflets.size(); ++l) {
    double sum = 0, distance = 0;
    for (const Vec3 &p : points) {
      nearest(
          s, p, [&](uint32_t t) { return s.before.valve.triangle_leaflet[t] == l; }, distance);
      sum += distance;
    }
    if (sum >= least) continue;
    least = sum;
    best = l;
  }
  return best;
}

// Largest distance of an outline point from the leaflet, m.
constexpr double farthest_point = 5e-3;
// Least distance of two outline points, m; the mesh does not resolve less.
constexpr double finest = 0.05e-3;

std::vector<Vec2> points_on(const Surgery &s, const std::vector<Vec3> &points, const Flat &flat) {
  const Valve &valve = s.before.valve;
  std::vector<Vec2> line;
  for (size_t k = 0; k < points.size(); ++k) {
    double distance = 0;
    const auto on_piece = [&](uint32_t t) { return flat.has(valve, t); };
    const SheetPoint at = nearest(s, points[k], on_piece, distance);
    MVS_MUST(
        distance < farthest_point, MVS_E_OP, "resect.outline",
        "resect: point %zu of the outline lies %.1f mm from leaflet %s: draw it on the leaflet "
        "in its present position",
        k, 1e3 * distance, valve.leaflets[flat.leaflet].name.c_str());
    const Vec2 p = flat.point(valve, at);
    if (line.empty() || (p - line.back()).norm() > finest) line.push_back(p);
  }
  return line;
}

bool segments_cross(const Vec2 &a, const Vec2 &b, const Vec2 &c, const Vec2 &d) {
  const auto side = [](const Vec2 &p, const Vec2 &q, const Vec2 &r) {
    return (q - p).dot(turned(r - p)) > 0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

void check_line(const Surgery &s, const std::vector<Vec2> &line, const FlatEdges &free) {
  MVS_MUST(line.size() >= 3, MVS_E_OP, "resect.outline",
           "resect: the outline has fewer than 3 points on the leaflet: draw it from free edge to "
           "free edge");
  for (const Vec2 &end : {line.front(), line.back()}) {
    const double away = nearest_along(free, end).distance;
    MVS_MUST(away < s.valve.contact_thickness, MVS_E_OP, "resect.outline",
             "resect: the outline ends %.1f mm from the free edge: begin and end it on or beyond "
             "the free edge",
             1e3 * away);
  }
  for (size_t k = 0; k + 1 < line.size(); ++k) {
    for (size_t l = k + 2; l + 1 < line.size(); ++l) {
      MVS_MUST(!segments_cross(line[k], line[k + 1], line[l], line[l + 1]), MVS_E_OP,
               "resect.outline", "resect: the outline crosses itself: draw it without a loop");
    }
  }
}

// Outline points beyond the free edge project onto it: one at each end is enough.
void trim_to_edge(std::vector<Vec2> &line, const FlatEdges &free) {
  const auto on_edge = [&](const Vec2 &p) { return nearest_along(free, p).distance < finest; };
  while (line.size() > 2 && on_edge(line[0]) && on_edge(line[1])) line.erase(line.begin());
  while (line.size() > 2 && on_edge(line.back()) && on_edge(line[line.size() - 2])) line.pop_back();
}

ResectPlan plan_outline(const Surgery &s, const mvs_op_resect &op) {
  MVS_MUST(
      op.scallop == 0 && op.position == 0 && op.width == 0 && op.base_width == 0 && op.depth == 0,
      MVS_E_ARGUMENT, "resect.outline",
      "resect: give an outline, or scallop, position, width, base_width and depth, not both");
  const std::vector<Vec3> points = points_of(op.outline);
  const uint32_t leaflet = leaflet_of(s, points);
  const Valve &valve = s.before.valve;
  double distance = 0;
  Vec3 middle = Vec3::Zero();
  for (const Vec3 &p : points) middle += p / static_cast<double>(points.size());
  const SheetPoint inside = nearest(
      s, middle, [&](uint32_t t) { return valve.triangle_leaflet[t] == leaflet; }, distance);
  ResectPlan plan;
  plan.flat = flatten(s.before, inside.triangle);
  plan.scallop = valve.triangle_scallop[inside.triangle];
  plan.line = points_on(s, points, plan.flat);
  const auto free = free_edges_on(s, plan.flat);
  trim_to_edge(plan.line, free);
  check_line(s, plan.line, free);
  for (const Vec2 &p : plan.line) {
    plan.depth = std::max(plan.depth, distance_to_segment(p, plan.line.front(), plan.line.back()));
  }
  return plan;
}

void check_annulus(const Surgery &s, const ResectPlan &plan) {
  const std::vector<uint32_t> &annulus = s.before.valve.annulus;
  const Outline outline = plan.outline();
  for (size_t k = 0; k < annulus.size(); ++k) {
    const uint32_t a = annulus[k], b = annulus[(k + 1) % annulus.size()];
    if (!plan.flat.has(a) || !plan.flat.has(b)) continue;
    bool reached = outline.holds(plan.flat.at[a]);
    for (const Vec2 &p : plan.line) {
      reached |= distance_to_segment(p, plan.flat.at[a], plan.flat.at[b]) < least_rim(s);
    }
    MVS_MUST(!reached, MVS_E_OP, "annulus",
             "resect: the cut reaches the annulus: leave at least %.1f mm of tissue below it",
             1e3 * least_rim(s));
  }
}

void check_size(const Surgery &s, const ResectPlan &plan) {
  double sum = 0, count = 0, area = 0;
  for (uint32_t t = 0; t < s.before.rest_area.size(); ++t) {
    if (!plan.flat.has(s.before.valve, t)) continue;
    sum += s.before.rest_area[t];
    ++count;
  }
  area = Outline(plan.line).area();
  MVS_MUST(area >= sum / count, MVS_E_OP, "outline",
           "resect: the piece of %.1f mm2 is smaller than a triangle of this mesh, %.1f mm2: take "
           "more, or a finer mesh",
           1e6 * area, 1e6 * sum / count);
}

// Computes the direction out of the leaflet at the ends of the line, and the bulge of the free edge
// in that direction between them.
void close_beyond_edge(ResectPlan &plan, const FlatEdges &free) {
  const Vec2 first = plan.line.front(), last = plan.line.back();
  plan.out = turned(last - first).normalized();
  double inwards = 0;
  for (const Vec2 &p : plan.line) inwards += (p - first).dot(plan.out);
  if (inwards > 0) plan.out = -plan.out;
  const Along a = nearest_along(free, first), b = nearest_along(free, last);
  if (a.stretch != b.stretch) return;
  const auto [low, high] = std::minmax(a.arc, b.arc);
  double arc = 0;
  for (size_t k = 0; k + 1 < a.stretch->size(); ++k) {
    const Vec2 &p = (*a.stretch)[k];
    if (arc > low && arc < high) plan.bulge = std::max(plan.bulge, (p - first).dot(plan.out));
    arc += ((*a.stretch)[k + 1] - p).norm();
  }
}

}  // namespace

// Extends both ends straight beyond the free edge, then perpendicular by the bulge of the edge and
// no farther, since the flattened leaflet is curved and may extend around.
Outline ResectPlan::outline() const {
  constexpr double past = 0.5e-3;
  std::vector<Vec2> points = line;
  const Vec2 first = line[0] + past * (line[0] - line[1]).normalized();
  const Vec2 last = line.back() + past * (line.back() - line[line.size() - 2]).normalized();
  points.insert(points.begin(), first);
  points.push_back(last);
  points.push_back(last + (bulge + past) * out);
  points.push_back(first + (bulge + past) * out);
  return Outline(std::move(points));
}

ResectPlan plan_resection(const Surgery &s, const mvs_op_resect &op) {
  ResectPlan plan = op.outline.count > 0 ? plan_outline(s, op) : plan_shape(s, op);
  close_beyond_edge(plan, free_edges_on(s, plan.flat));
  check_annulus(s, plan);
  check_size(s, plan);
  return plan;
}

}  // namespace mvs::core
