// Distances between two shapes in place and after rigid registration.
#include "measure/comparison/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/annulus/frame.h"
#include "measure/comparison/register.h"
#include "measure/comparison/surface_distance.h"

namespace mvs::core {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<Vec3> sheet_points(const Model &model, const std::vector<Vec3> &x) {
  const Rows &rows = model.topology.node_triangles;
  std::vector<Vec3> points;
  for (size_t n = 0; n < x.size(); ++n) {
    if (rows.start[n + 1] > rows.start[n]) points.push_back(x[n]);
  }
  return points;
}

struct NodeDistance {
  double rms = unknown, max = unknown;
};

NodeDistance between_nodes(const std::vector<Vec3> &a, const std::vector<Vec3> &b,
                           const Rigid &motion) {
  double squares = 0, max2 = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double distance2 = (motion(a[i]) - b[i]).squaredNorm();
    squares += distance2;
    max2 = std::max(max2, distance2);
  }
  return {std::sqrt(squares / static_cast<double>(a.size())), std::sqrt(max2)};
}

// Distances from the samples of one surface, moved, to another surface.
SurfaceDistance one_way(const SampledSurface &from, const SampledSurface &to, const Rigid &motion) {
  SurfaceDistance sum;
  for (const SampledSurface::Sample &sample : from.samples()) {
    const double distance2 = to.tree().closest(motion(sample.point)).distance2;
    sum = sum + SurfaceDistance{sample.weight * distance2, sample.weight, std::sqrt(distance2)};
  }
  return sum;
}

SurfaceDistance both_ways(const SampledSurface &a, const SampledSurface &b, const Rigid &motion) {
  return one_way(a, b, motion) + one_way(b, a, motion.inverse());
}

}  // namespace

Comparison compare_shapes(const Model &a, const std::vector<Vec3> &xa, const Model &b,
                          const std::vector<Vec3> &xb) {
  const std::vector<Vec3> points_a = sheet_points(a, xa), points_b = sheet_points(b, xb);
  const SampledSurface surface_a(a.valve.triangles, xa), surface_b(b.valve.triangles, xb);
  Comparison comparison;
  comparison.same_mesh = a.node_count() == b.node_count() && a.valve.triangles == b.valve.triangles;

  const Rigid best =
      comparison.same_mesh
          ? register_points(points_a, points_b)
          : register_surfaces(surface_a, surface_b, align(valve_frame(a, xa), valve_frame(b, xb)));
  NodeDistance nodes, nodes_registered;
  if (comparison.same_mesh) {
    nodes = between_nodes(points_a, points_b, {});
    nodes_registered = between_nodes(points_a, points_b, best);
  }
  comparison.node_rms = nodes.rms;
  comparison.node_max = nodes.max;
  comparison.node_rms_registered = nodes_registered.rms;
  comparison.node_max_registered = nodes_registered.max;

  const SurfaceDistance surfaces = both_ways(surface_a, surface_b, {});
  const SurfaceDistance registered = both_ways(surface_a, surface_b, best);
  comparison.surface_rms = surfaces.rms();
  comparison.surface_max = surfaces.max;
  comparison.surface_rms_registered = registered.rms();
  comparison.surface_max_registered = registered.max;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      comparison.registration[4 * row + column] = best.turn(row, column);
    }
    comparison.registration[4 * row + 3] = best.shift[row];
  }
  return comparison;
}

}  // namespace mvs::core
