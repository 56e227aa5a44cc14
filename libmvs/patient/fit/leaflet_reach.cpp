// Shortest paths along edges, with a heap; the free edge that belongs to a point of a rim.
#include "patient/fit/leaflet_reach.h"

#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "geometry/triangle_bvh.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/annulus/closed_curve.h"

namespace mvs::core {
namespace {

// The lengths of the shortest paths to each vertex, m, from those that have one in `length`;
// HUGE_VAL where no path leads.
void spread(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
            std::vector<double> &length) {
  const Rows stars = rows_of(points.size(), triangles);
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (uint32_t v = 0; v < points.size(); ++v) {
    if (length[v] < HUGE_VAL) open.emplace(length[v], v);
  }
  while (!open.empty()) {
    const auto [here, v] = open.top();
    open.pop();
    if (here > length[v]) continue;
    for (const uint32_t t : stars[v]) {
      for (const uint32_t w : triangles[t]) {
        const double next = here + (points[w] - points[v]).norm();
        if (w == v || next >= length[w]) continue;
        length[w] = next;
        open.emplace(next, w);
      }
    }
  }
}

std::vector<double> reach_of_valve(const Model &model, const std::vector<Vec3> &x) {
  std::vector<double> length(x.size(), HUGE_VAL);
  for (const uint32_t i : model.valve.annulus) length[i] = 0;
  spread(x, model.valve.triangles, length);
  return length;
}

std::vector<double> reach_of_surface(const LeafletTriangles &surface, double band,
                                     const ClosedCurve &annulus) {
  std::vector<double> length;
  length.reserve(surface.points.size());
  for (const Vec3 &p : surface.points) {
    const double distance = (annulus.at(annulus.nearest(p)) - p).norm();
    length.push_back(distance <= band ? distance : HUGE_VAL);
  }
  spread(surface.points, surface.triangles, length);
  return length;
}

// The leaflet at each point on a rim; none elsewhere.
constexpr uint32_t not_on_rim = UINT32_MAX;
std::vector<uint32_t> leaflet_at_rims(const LeafletTriangles &surface) {
  std::vector<uint32_t> leaflet(surface.points.size(), not_on_rim);
  const std::vector<Side> sides = sorted_sides(surface.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last != first + 1) return;
    for (const uint32_t v : sides[first].edge) leaflet[v] = surface.leaflet[sides[first].triangle];
  });
  return leaflet;
}

// The vertex of the free edge on the same fibre as a vertex, or the next one.
uint32_t free_edge_below(const PatientGeometry &g, uint32_t vertex) {
  const SheetCoordinates &at = g.coordinates;
  uint32_t below = g.rims.free_edge[0];
  double least = HUGE_VAL;
  for (const uint32_t i : g.rims.free_edge) {
    const double apart = std::abs(around(at.foot[vertex], at.foot[i], at.annulus_length));
    if (apart >= least) continue;
    least = apart;
    below = i;
  }
  return below;
}

}  // namespace

std::vector<double> missing_reach(const LeafletTriangles &surface, double band, const Model &model,
                                  const std::vector<Vec3> &x, const PatientGeometry &g) {
  const Valve &valve = model.valve;
  const std::vector<double> of_valve = reach_of_valve(model, x);
  const std::vector<double> of_surface =
      reach_of_surface(surface, band, ClosedCurve(points_along(valve.annulus, x)));
  std::vector<std::vector<Tri>> triangles(valve.leaflets.size());
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    triangles[valve.triangle_leaflet[t]].push_back(valve.triangles[t]);
  }
  std::vector<TriangleBvh> trees;
  trees.reserve(triangles.size());
  for (const std::vector<Tri> &leaflet : triangles) trees.emplace_back(leaflet, x);
  const std::vector<uint32_t> leaflet = leaflet_at_rims(surface);
  std::vector<double> missing(surface.points.size(), NAN);
  for (size_t v = 0; v < missing.size(); ++v) {
    if (leaflet[v] == not_on_rim || !(of_surface[v] < HUGE_VAL)) continue;
    const TriangleBvh::Hit hit = trees[leaflet[v]].closest(surface.points[v]);
    const uint32_t near = triangles[leaflet[v]][hit.triangle][0];
    missing[v] = of_valve[free_edge_below(g, near)] - of_surface[v];
  }
  return missing;
}

}  // namespace mvs::core
