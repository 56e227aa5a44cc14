// Operation patch: enlarges an elliptic part of a leaflet by giving it the rest shape of a dome.
#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "geometry/intersect.h"
#include "model/sides.h"
#include "surgery/leaflet/flat.h"
#include "surgery/leaflet/site.h"

namespace mvs::core {
namespace {

// An ellipse on the flattened leaflet.
struct Ellipse {
  Vec2 middle, across;  // across: unit, circumferential
  double width, height;

  // Maps the ellipse to the unit circle.
  Vec2 scaled(const Vec2 &p) const {
    const Vec2 d = p - middle, up(-across.y(), across.x());
    return {2 * d.dot(across) / width, 2 * d.dot(up) / height};
  }
};

// The tissue inside the ellipse.
struct PatchRegion {
  std::vector<uint32_t> triangles;
  std::vector<uint32_t> nodes;  // with all their triangles inside
  std::vector<Vec3> lift;       // displacement of such a node for a dome of height 1 m
};

// Centres the ellipse at the site; its width is perpendicular to the direction from the annulus to
// the free edge.
Ellipse ellipse_of(const Surgery &s, const mvs_op_patch &op, const SheetPoint &site,
                   const Flat &flat) {
  const Valve &valve = s.before.valve;
  Ellipse ellipse{flat.point(valve, site), Vec2::UnitX(), op.width != 0 ? op.width : 12e-3,
                  op.height != 0 ? op.height : 8e-3};
  mvs_site here = {
      MVS_SITE_TRIANGLE, site.triangle, 0, {site.weight[0], site.weight[1], site.weight[2]}};
  mvs_site foot = anatomical(s.before, here), edge = foot;
  foot.u[1] = 0;
  edge.u[1] = 1;
  const SheetPoint low = locate(s, foot), high = locate(s, edge);
  if (!flat.has(valve, low.triangle) || !flat.has(valve, high.triangle)) return ellipse;
  const Vec2 up = (flat.point(valve, high) - flat.point(valve, low)).normalized();
  ellipse.across = {up.y(), -up.x()};
  return ellipse;
}

// Name of the border at an edge of the leaflet.
const char *border(const Surgery &s, size_t e) {
  const Topology &topology = s.before.topology;
  if (topology.edge_triangles[e][1] != none) return "another leaflet";
  const Edge &edge = topology.edges[e];
  return topology.fixed[edge[0]] && topology.fixed[edge[1]] ? "the annulus" : "the free edge";
}

void check_borders(const Surgery &s, const Flat &flat, const Ellipse &ellipse) {
  const Valve &valve = s.before.valve;
  const Topology &topology = s.before.topology;
  for (size_t e = 0; e < topology.edges.size(); ++e) {
    const auto [t, u] = topology.edge_triangles[e];
    const bool here = flat.has(valve, t), there = u != none && flat.has(valve, u);
    if (here == there) continue;
    const auto [a, b] = topology.edges[e];
    const double away =
        distance_to_segment(Vec2::Zero(), ellipse.scaled(flat.at[a]), ellipse.scaled(flat.at[b]));
    MVS_MUST(away > 1, MVS_E_OP, "patch.site",
             "patch: %.1f x %.1f mm around this site reach %s: take a smaller patch, or move it "
             "into the middle of the leaflet",
             1e3 * ellipse.width, 1e3 * ellipse.height, border(s, e));
  }
}

PatchRegion piece_in(const Surgery &s, const Flat &flat, const Ellipse &ellipse) {
  const Valve &valve = s.before.valve;
  PatchRegion piece;
  std::vector<uint8_t> inside(valve.triangles.size(), 0);
  for (uint32_t t = 0; t < inside.size(); ++t) {
    if (!flat.has(valve, t)) continue;
    const Tri &tri = valve.triangles[t];
    const Vec2 middle = (flat.at[tri[0]] + flat.at[tri[1]] + flat.at[tri[2]]) / 3;
    inside[t] = ellipse.scaled(middle).norm() < 1;
    if (inside[t]) piece.triangles.push_back(t);
  }
  for (uint32_t n = 0; n < valve.rest.size(); ++n) {
    const auto around = s.before.topology.node_triangles[n];
    const auto is_inside = [&](uint32_t t) { return inside[t] != 0; };
    if (around.empty() || !std::all_of(around.begin(), around.end(), is_inside)) continue;
    Vec3 normal = Vec3::Zero();
    for (const uint32_t t : around) {
      const Tri &tri = valve.triangles[t];
      normal +=
          (valve.rest[tri[1]] - valve.rest[tri[0]]).cross(valve.rest[tri[2]] - valve.rest[tri[0]]);
    }
    const double hollow = 1 - std::min(1.0, ellipse.scaled(flat.at[n]).squaredNorm());
    piece.nodes.push_back(n);
    piece.lift.push_back(hollow * normal.normalized());
  }
  MVS_MUST(piece.triangles.size() >= 4 && !piece.nodes.empty(), MVS_E_OP, "patch.width",
           "patch: only %zu triangles of this mesh lie inside %.1f x %.1f mm: take a larger patch, "
           "or a finer mesh",
           piece.triangles.size(), 1e3 * ellipse.width, 1e3 * ellipse.height);
  return piece;
}

double area_of(const Valve &valve, const std::vector<Vec3> &rest, const PatchRegion &piece) {
  double sum = 0;
  for (const uint32_t t : piece.triangles) {
    sum += triangle_area(rest, valve.triangles.get()[t]);
  }
  return sum;
}

std::vector<Vec3> domed(const Valve &valve, const PatchRegion &piece, double height) {
  std::vector<Vec3> rest = valve.rest;
  for (size_t k = 0; k < piece.nodes.size(); ++k) rest[piece.nodes[k]] += height * piece.lift[k];
  return rest;
}

// Returns the dome with the wanted area, by bisection over its height.
std::vector<Vec3> dome_of(const Surgery &s, const PatchRegion &piece, const Ellipse &ellipse,
                          double factor) {
  const Valve &valve = s.before.valve;
  const double wanted = factor * area_of(valve, valve.rest, piece);
  // a dome this high has more than three times the area of its base, unless the mesh is too coarse
  double low = 0, high = 2 * std::max(ellipse.width, ellipse.height);
  const double most = area_of(valve, domed(valve, piece, high), piece);
  MVS_MUST(
      most > wanted, MVS_E_OP, "patch.area_factor",
      "patch: with %zu nodes inside no dome has %.2f times the area: take a larger patch, or a "
      "finer mesh",
      piece.nodes.size(), factor);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (area_of(valve, domed(valve, piece, middle), piece) < wanted ? low : high) = middle;
  }
  return domed(valve, piece, high);
}

}  // namespace

void operate(Surgery &s, const mvs_op_patch &op) {
  const double factor = op.area_factor != 0 ? op.area_factor : 1.3;
  const double thickness = op.thickness != 0 ? op.thickness : 0.4e-3;
  const SheetPoint site = locate(s, op.site);
  const Flat flat = flatten(s.before, site.triangle);
  const Ellipse ellipse = ellipse_of(s, op, site, flat);
  check_borders(s, flat, ellipse);
  const PatchRegion piece = piece_in(s, flat, ellipse);
  const std::vector<Vec3> rest = dome_of(s, piece, ellipse, factor);
  const std::vector<Tri> &triangles = s.before.valve.triangles;
  const size_t crossings = find_intersections(s.before.valve.rest, triangles).size();
  MVS_MUST(find_intersections(rest, triangles).size() <= crossings, MVS_E_OP, "patch.area_factor",
           "patch: a dome of %.2f times the area would intersect the valve: take a smaller "
           "area_factor or a larger patch",
           factor);
  for (const uint32_t n : piece.nodes)
    s.valve.rest[n] = s.valve.open[n] = s.valve.loaded[n] = rest[n];
  for (const uint32_t t : piece.triangles) s.valve.triangle_thickness[t] = thickness;
  const uint32_t scallop = s.before.valve.triangle_scallop[site.triangle];
  s.title = format("Patch %s, %.1f x %.1f mm, with %.0f %% more area",
                   s.before.valve.scallops[scallop].name.c_str(), 1e3 * ellipse.width,
                   1e3 * ellipse.height, 100 * (factor - 1));
}

}  // namespace mvs::core
