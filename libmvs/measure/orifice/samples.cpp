// Samples the sheet by graded bisection and builds the wall around it.
#include "measure/orifice/samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/bvh.h"
#include "model/sides.h"

namespace mvs::core::orifice {
namespace {

// Spacing over contact thickness: with three quarters a ball of that diameter cannot pass between
// the samples (see smallest_cut.cpp), and the width at which an opening counts as closed is right
// to a tenth.
constexpr double grain_of_seal = 0.75;
// Finest spacing over the length of the rims and over the root of the sheet area: limits the work
// for a tiny contact thickness or a torn sheet. A quarter of a millimetre for a mitral valve. Next,
// the ratio of coarsest to finest spacing.
constexpr double grain_of_rim = 1e-3, grain_of_size = 1.0 / 150;
constexpr double coarsest = 4;
// Edge length over the distance to opposite tissue, and growth rate of edges away from a rim.
constexpr double growth = 0.5;
// Share of the contact thickness below which leaflets are in deep contact. Samples may be coarse
// there: a ball that is stopped by them is stopped by the contact, too.
constexpr double deep_of_seal = 0.8;
// Tissue within 60 degrees of the normal faces a point, which excludes the neighbourhood of the
// point itself.
constexpr double facing_cosine = 0.5;

bool faces_something(const TriangleBvh &tree, const Vec3 &p, const Vec3 &normal, double within) {
  double limit2 = within * within;
  bool found = false;
  tree.visit_near(p, limit2, [&](uint32_t t) {
    const TrianglePoint hit = tree.closest_on(t, p);
    // excludes the triangle on which the point lies, for which the direction is rounding error
    if (found || hit.distance2 >= limit2 || hit.distance2 < 1e-6 * within * within) return;
    const Vec3 direction = tree.point_at(t, hit.weight) - p;
    found = std::abs(direction.dot(normal)) > facing_cosine * std::sqrt(hit.distance2);
    if (found) limit2 = 0;
  });
  return found;
}

Mesh refined(const Sheet &sheet) {
  const std::vector<Tri> rim = as_triangles(sheet.rim);
  const TriangleBvh rim_tree(rim, sheet.mesh.x), tree(sheet.mesh.triangles, sheet.mesh.x);
  Mesh mesh = sheet.mesh;
  bisect(mesh, [&](const BisectEdge &edge) {
    const double length = (edge.b - edge.a).norm();
    if (!(length > sheet.grain)) return false;
    if (edge.on_rim || length > coarsest * sheet.grain) return true;
    const Vec3 middle = 0.5 * (edge.a + edge.b), normal = edge.normal.normalized();
    if (rim_tree.is_within(middle, (length - sheet.grain) / growth)) return true;
    if (!faces_something(tree, middle, normal, length / growth)) return false;
    const auto is_deep = [&](const Vec3 &p) {
      return faces_something(tree, p, normal, deep_of_seal * sheet.seal);
    };
    return length > 2 * sheet.seal || !is_deep(middle) || !is_deep(edge.a) || !is_deep(edge.b);
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
    const Vec3 direction = Vec3(p.x(), p.y(), 0).normalized();
    samples.point.push_back(p + outwards * direction);
    samples.spacing.push_back(2 * step);
  }
}

void add_wall(const Sheet &sheet, Samples &samples) {
  double step = sheet.grain, outwards = 0, shift = 0.5;
  while (outwards < 2 * sheet.radius) {
    outwards += 0.85 * step;
    add_ring(sheet, outwards, step, shift, samples);
    step *= 1.5;
    shift = 0.5 - shift;
  }
}

}  // namespace

std::vector<Tri> as_triangles(const std::vector<Edge> &edges) {
  std::vector<Tri> triangles;
  triangles.reserve(edges.size());
  for (const Edge &edge : edges) triangles.push_back({edge[0], edge[1], edge[1]});
  return triangles;
}

Sheet local_sheet(const Model &model, const std::vector<Vec3> &local) {
  const Valve &valve = model.valve;
  Sheet sheet{compact_mesh(local, valve.triangles),
              {},
              Loop(valve.annulus, local),
              valve.contact_thickness,
              0,
              0};
  const std::vector<Side> sides = sorted_sides(sheet.mesh.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 1) sheet.rim.push_back(sides[first].edge);
  });
  double rim = 0;
  for (const Edge &e : sheet.rim) rim += (sheet.mesh.x[e[0]] - sheet.mesh.x[e[1]]).norm();
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
