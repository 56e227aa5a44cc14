// Checks that node coordinates are finite, in metres, and within one valve.
#include <cmath>

#include "base/median.h"
#include "model/checks/checks.h"
#include "model/checks/extent.h"

namespace mvs::core {
namespace {

// An adult mitral valve spans about 40 mm; a mouse's about 2 mm, a whale's below 300 mm.
constexpr double smallest_valve = 1e-3, largest_valve = 0.4;
constexpr double smallest_in_mm = 8;  // m: an extent above 8 means mm, below it cm
// Limits in units of the valve size: distance of a node from the centre, displacement of a held
// node.
constexpr double far_away = 10, far_moved = 2;

Extent extent_of_points(const std::vector<Vec3> &points) {
  Extent extent{Vec3::Zero(), 0};
  std::vector<double> values(points.size());
  for (int k = 0; k < 3; ++k) {
    for (size_t i = 0; i < points.size(); ++i) values[i] = points[i][k];
    extent.centre[k] = median_of(values);
  }
  for (size_t i = 0; i < points.size(); ++i) values[i] = (points[i] - extent.centre).norm();
  extent.size = 2 * median_of(values);
  return extent;
}

void check_numbers(const std::vector<Vec3> &points, const char *what, Faults &faults) {
  for (size_t n = 0; n < points.size(); ++n) {
    // coordinates near the limit of double would overflow in a norm
    if (points[n].allFinite() && points[n].cwiseAbs().maxCoeff() < 1e100) continue;
    faults.add(format("node %zu", n),
               "node %zu has a %s coordinate that is not a usable number (%g, %g, %g)", n, what,
               points[n][0], points[n][1], points[n][2]);
  }
}

void check_units(const Extent &extent, Faults &faults) {
  if (extent.size > largest_valve) {
    const bool cm = extent.size < smallest_in_mm;
    faults.add("nodes", "the valve is %.3g m across: looks like %s given as m; multiply by %g",
               extent.size, cm ? "cm" : "mm", cm ? 0.01 : 0.001);
  } else if (extent.size < smallest_valve) {
    faults.add("nodes",
               "the valve is %.3g m across: looks like m converted to m once more (or km); "
               "coordinates are in metres, a valve spans about 0.04",
               extent.size);
  }
}

void check_strays(const Valve &valve, const Extent &extent, Faults &faults) {
  for (size_t n = 0; n < valve.rest.size(); ++n) {
    if (!is_far(extent, valve.rest[n])) continue;
    faults.add(format("node %zu", n),
               "node %zu lies %.3g m from the middle of a valve of %.3g m: remove or correct it", n,
               (valve.rest[n] - extent.centre).norm(), extent.size);
  }
}

// The prescribed nodes; open and loaded positions are used for these only.
std::vector<uint32_t> held_nodes(const Valve &valve) {
  std::vector<uint32_t> held = valve.annulus;
  for (const Head &head : valve.heads) held.push_back(head.node);
  return held;
}

void check_held(const Valve &valve, const CowVector<Vec3> &places, const char *which,
                const Extent &extent, Faults &faults) {
  if (places.empty()) return;
  for (const uint32_t node : held_nodes(valve)) {
    const Vec3 &p = places[node];
    if (!p.allFinite()) {
      faults.add(format("node %u", node), "node %u has a position when %s that is not a number",
                 node, which);
    } else if (const double moved = (p - valve.rest[node]).norm();
               !(moved <= far_moved * extent.size)) {
      faults.add(format("node %u", node),
                 "node %u is %.3g m from its rest position when %s, in a valve of %.3g m: looks "
                 "like nodes_%s in other units than nodes",
                 node, moved, which, extent.size, which);
    }
  }
}

void check_rings(const Valve &valve, const Extent &extent, Faults &faults) {
  for (size_t r = 0; r < valve.rings.size(); ++r) {
    for (const Vec3 &p : valve.rings[r].curve) {
      if (!is_far(extent, p)) continue;
      faults.add(format("ring %zu", r), "ring %zu has a point that is not a number or far away", r);
      break;
    }
  }
}

}  // namespace

Extent extent_of(const Valve &valve) {
  return extent_of_points(valve.rest);
}

bool is_far(const Extent &extent, const Vec3 &place) {
  return !((place - extent.centre).norm() <= far_away * extent.size);
}

void check_places(const Valve &valve, Faults &faults) {
  const size_t before = faults.list.size();
  check_numbers(valve.rest, "rest", faults);
  if (faults.list.size() > before) return;
  const Extent extent = extent_of(valve);
  check_units(extent, faults);
  check_strays(valve, extent, faults);
  check_held(valve, valve.open, "open", extent, faults);
  check_held(valve, valve.loaded, "loaded", extent, faults);
  check_rings(valve, extent, faults);
}

}  // namespace mvs::core
