// Samples the sheet by graded bisection and builds the wall around it.
#include "measure/orifice/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/distance.h"
#include "measure/orifice/rim_parts.h"
#include "measure/orifice/wall.h"

namespace mvs::core::orifice {
namespace {

// Spacing over contact thickness: with three quarters a ball of that diameter cannot pass between
// the samples (see smallest_cut.cpp). An opening counts as closed up to that diameter, and some do
// up to 1.3 times as wide (METHOD.md, Limits).
constexpr double grain_of_seal = 0.75;
// Finest spacing over the length of the rims and over the root of the sheet area: limits the work
// for a tiny contact thickness or a torn sheet. A quarter of a millimetre for a mitral valve.
constexpr double grain_of_rim = 1e-3, grain_of_size = 1.0 / 150;
// The first step of the wall over the finest spacing, and over the distance from the annulus to
// another rim, which may be an opening.
constexpr double wall_of_grain = 2, wall_of_distance = 0.5;

Mesh refined(const Sheet &sheet) {
  const Opposite tissue(sheet.mesh.triangles, sheet.mesh.x);
  const Spacing spacing(sheet);
  const RimParts rim(sheet, tissue, spacing);
  Mesh mesh = sheet.mesh;
  bisect(mesh, [&](const BisectEdge &edge) {
    const double length = (edge.b - edge.a).norm();
    if (!(length > spacing.finest)) return false;
    if (length > spacing.coarsest) return true;
    if (rim.is_too_long(0.5 * (edge.a + edge.b), length)) return true;
    return !edge.on_rim && spacing.is_too_long(tissue, edge.a, edge.b, edge.normal.normalized());
  });
  return mesh;
}

std::vector<double> longest_edges(const Mesh &mesh) {
  std::vector<double> longest(mesh.x.size(), 0);
  for (const Tri &t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      const double length = (mesh.x[a] - mesh.x[b]).norm();
      longest[a] = std::max(longest[a], length);
      longest[b] = std::max(longest[b], length);
    }
  }
  return longest;
}

// Adds one ring of the wall: points at equal steps along the annulus, moved outwards.
void add_ring(const Sheet &sheet, double outwards, double step, double shift, Samples &samples) {
  const double length = sheet.annulus.length(), wider = 2 * std::numbers::pi * outwards;
  const size_t count = std::max<size_t>(12, std::lround(std::ceil((length + wider) / step)));
  for (size_t i = 0; i < count; ++i) {
    const double part = (static_cast<double>(i) + shift) / static_cast<double>(count);
    const Vec3 p = sheet.annulus.at(part * length);
    samples.point.push_back(p + outwards * outwards_at(p));
    samples.spacing.push_back(2 * step);
  }
}

// The distance from the annulus to the rest of the rim: free edges and holes.
double distance_to_other_rim(const Sheet &sheet) {
  double least2 = std::numeric_limits<double>::infinity();
  for (const Side &side : sheet.rim) {
    const Edge &edge = side.edge;
    double middle2 = std::numeric_limits<double>::infinity();
    const Vec3 middle = 0.5 * (sheet.mesh.x[edge[0]] + sheet.mesh.x[edge[1]]);
    for (size_t k = 0; k < sheet.annulus.size(); ++k) {
      const Vec3 &a = sheet.annulus.point(k), &b = sheet.annulus.point(k + 1);
      middle2 = std::min(middle2, closest_on_segment(middle, a, b).distance2);
    }
    const double length2 = (sheet.mesh.x[edge[0]] - sheet.mesh.x[edge[1]]).squaredNorm();
    if (middle2 > 1e-12 * length2) least2 = std::min(least2, middle2);
  }
  return std::sqrt(least2);
}

void add_wall(const Sheet &sheet, Samples &samples) {
  double step = std::clamp(wall_of_distance * distance_to_other_rim(sheet), sheet.grain,
                           wall_of_grain * sheet.grain);
  double outwards = 0, shift = 0.5;
  while (outwards < 2 * sheet.radius) {
    outwards += 0.85 * step;
    add_ring(sheet, outwards, step, shift, samples);
    step *= 1.5;
    shift = 0.5 - shift;
  }
}

}  // namespace

std::vector<Tri> as_triangles(const std::vector<Side> &sides) {
  std::vector<Tri> triangles;
  triangles.reserve(sides.size());
  for (const Side &s : sides) triangles.push_back({s.edge[0], s.edge[1], s.edge[1]});
  return triangles;
}

Sheet local_sheet(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                  const Model &model, const std::vector<Vec3> &x, const Frame &frame) {
  const Valve &valve = model.valve;
  Sheet sheet{compact_mesh(frame.local(points), triangles),
              {},
              Loop(valve.annulus, frame.local(x)),
              valve.contact_thickness,
              0,
              0};
  const std::vector<Side> sides = sorted_sides(sheet.mesh.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 1) sheet.rim.push_back(sides[first]);
  });
  double rim = 0;
  for (const Side &s : sheet.rim) {
    rim += (sheet.mesh.x[s.edge[0]] - sheet.mesh.x[s.edge[1]]).norm();
  }
  for (const Vec3 &p : sheet.mesh.x) sheet.radius = std::max(sheet.radius, p.norm());
  sheet.grain = std::max({grain_of_seal * sheet.seal, grain_of_rim * rim,
                          grain_of_size * std::sqrt(area_of(sheet.mesh))});
  return sheet;
}

Samples sample(const Sheet &sheet) {
  const Mesh mesh = refined(sheet);
  Samples samples;
  samples.point = mesh.x;
  samples.spacing = longest_edges(mesh);
  samples.on_sheet = mesh.x.size();
  add_wall(sheet, samples);
  return samples;
}

}  // namespace mvs::core::orifice
