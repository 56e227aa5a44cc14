// Edges, the least angle, distances in both directions, crossings.
#include "patient/mesh/remesh_report.h"

#include <algorithm>

#include "base/math.h"
#include "geometry/intersect.h"
#include "geometry/triangle_bvh.h"
#include "patient/mesh/sheet_edit.h"

namespace mvs::core {

RemeshReport report_on(const InputSheet &input, const SheetMesh &mesh, const LeafletSheet &made) {
  RemeshReport report;
  double sum = 0;
  report.shortest = 1e300;
  const std::vector<Edge> edges = mesh.edges();
  for (const auto &[a, b] : edges) {
    const double length = mesh.length(a, b);
    sum += length;
    if (length < report.shortest) {
      report.shortest = length;
      report.shortest_at = 0.5 * (mesh.x[a] + mesh.x[b]);
    }
    report.longest = std::max(report.longest, length);
  }
  report.mean_edge = sum / static_cast<double>(edges.size());
  double worst = -1;
  for (const Tri &t : mesh.triangles) {
    if (t[0] == none) continue;
    const Vec3 &a = mesh.x[t[0]], &b = mesh.x[t[1]], &c = mesh.x[t[2]];
    const double cosine = worst_cosine(a, b, c);
    if (cosine > worst) {
      worst = cosine;
      report.worst_at = (a + b + c) / 3;
    }
    const Vec3 samples[] = {a, 0.5 * (a + b), (a + b + c) / 3};
    for (const Vec3 &p : samples) {
      double nearest2 = 1e300;
      for (const uint32_t v : t) {
        const Vec3 q = input.walk.at(input.walk.closest_from(mesh.vertex[v].place, p));
        nearest2 = std::min(nearest2, (q - p).squaredNorm());
      }
      report.largest_distance = std::max(report.largest_distance, std::sqrt(nearest2));
    }
  }
  const TriangleBvh bvh(made.triangles, made.x);
  for (const Vec3 &p : input.sheet.x) {
    report.largest_distance =
        std::max(report.largest_distance, std::sqrt(bvh.closest(p).distance2));
  }
  report.worst_angle = math::atan2(std::sqrt(std::max(0.0, 1 - worst * worst)), worst);
  report.crossings = find_intersections(made.x, made.triangles).size();
  return report;
}

}  // namespace mvs::core
