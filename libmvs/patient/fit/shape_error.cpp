// Distances of surfaces, vertices moved within a shape, gaps by part of the orifice.
#include "patient/fit/shape_error.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangle_bvh.h"
#include "measure/orifice/orifice.h"
#include "measure/regions/orifice_parts.h"
#include "model/sides.h"
#include "patient/fit/free_edge_shift.h"

namespace mvs::core {
namespace {

// The place of an edge is uncertain by so many times the root mean square of the distances: 95 % of
// normal deviates are within them.
constexpr double deviations = 1.96;

// Mean of the squared distances of points from a surface, by weight, m2.
double mean_square(const std::vector<Vec3> &points, const std::vector<double> &weight,
                   const std::vector<Tri> &triangles, const std::vector<Vec3> &x) {
  const TriangleBvh tree(triangles, x);
  double sum = 0, all = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!(weight[i] > 0)) continue;
    sum += weight[i] * tree.closest(points[i]).distance2;
    all += weight[i];
  }
  return all > 0 ? sum / all : 0;
}

// A third of the triangles around each point.
std::vector<double> point_areas(const ClosedSurface &surface) {
  std::vector<double> area(surface.points.size(), 0);
  for (const Tri &t : surface.triangles) {
    for (const uint32_t i : t) area[i] += triangle_area(surface.points, t) / 3;
  }
  return area;
}

double mean_square_from_valve(const ClosedSurface &given, const Model &model,
                              const std::vector<Vec3> &x) {
  return mean_square(given.points, point_areas(given), model.valve.triangles, x);
}

}  // namespace

double distance_from_valve(const ClosedSurface &given, const Model &model,
                           const std::vector<Vec3> &x) {
  return std::sqrt(mean_square_from_valve(given, model, x));
}

double distance_between(const ClosedSurface &given, const Model &model,
                        const std::vector<Vec3> &x) {
  const double there = mean_square(x, model.vertex_area, given.triangles, given.points);
  const double back = mean_square_from_valve(given, model, x);
  return std::sqrt(0.5 * (there + back));
}

double leak_with_edges_in(const Model &model, const std::vector<Vec3> &x, const PatientGeometry &g,
                          double by) {
  // where the vertices are on the sheet at rest after the move, they are in its present shape
  const std::vector<Vec3> &rest = g.sheet.x;
  const std::vector<Vec3> moved = with_edge_moved(model.valve, g, -by).rest;
  const TriangleBvh tree(g.sheet.triangles, rest);
  std::vector<Vec3> at = x;
  for (size_t i = 0; i < rest.size(); ++i) {
    if (moved[i] == rest[i]) continue;
    const uint32_t triangle = tree.closest(moved[i]).triangle;
    const std::array<double, 3> weight = tree.closest_on(triangle, moved[i]).weight;
    const Tri &t = g.sheet.triangles[triangle];
    at[i] = weight[0] * x[t[0]] + weight[1] * x[t[1]] + weight[2] * x[t[2]];
  }
  return measure_orifice(model, at).area;
}

double leak_of_narrower_gaps(const Model &model, const std::vector<Vec3> &x, double by) {
  const Orifice orifice = measure_orifice(model, x);
  double area = 0;
  for (const OrificePart &part : find_orifice_parts(model, x, RegionMap(model), orifice).parts) {
    const double gap = part.gap - 2 * by;
    if (gap > model.valve.contact_thickness) area += part.area * gap / part.gap;
  }
  return area;
}

ShapeLeaks leaks_of_shape(const Model &model, const std::vector<Vec3> &x, double leak,
                          const FittedShape &fitted) {
  ShapeLeaks leaks;
  leaks.distance = distance_between(*fitted.given, model, x);
  leaks.error = deviations * leaks.distance;
  leaks.least = std::min(leak, leak_of_narrower_gaps(model, x, leaks.error));
  leaks.most = std::max(leak, leak_with_edges_in(model, x, *fitted.geometry, leaks.error));
  return leaks;
}

}  // namespace mvs::core
