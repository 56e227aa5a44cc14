// Raster of the leaflets seen from the atrium, closed morphologically by a ball of the contact
// thickness; holes are filled from their borders inwards.
#include "measure/tenting/atrial_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/annulus/landmarks.h"
#include "measure/tenting/height_field.h"

namespace mvs::core {
namespace {

// Calls visit(cell) for the cells around a cell and itself, row by row.
template <typename Visit>
void for_each_around(size_t cell, Visit visit) {
  const int column = static_cast<int>(cell) % AnnulusMap::across;
  const int row = static_cast<int>(cell) / AnnulusMap::across;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, AnnulusMap::across - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, AnnulusMap::across - 1); ++c) {
      visit(AnnulusMap::at(c, r));
    }
  }
}

// Fills cells without a height by the mean of their neighbours, from the borders of each hole
// inwards: in each round those next to a cell that had a height before it.
void fill_holes(const AnnulusMap &map, std::vector<double> &leaflet) {
  const auto is_hole = [&](size_t c) { return map.inside(c) && std::isinf(leaflet[c]); };
  std::vector<size_t> front;
  for (size_t c = 0; c < leaflet.size(); ++c) {
    if (is_hole(c)) front.push_back(c);
  }
  std::vector<uint8_t> listed(front.empty() ? 0 : leaflet.size(), 0);
  std::vector<std::pair<size_t, double>> filled;
  do {
    filled.clear();
    for (const size_t cell : front) {
      double sum = 0, count = 0;
      for_each_around(cell, [&](size_t n) {
        if (!map.inside(n) || std::isinf(leaflet[n])) return;
        sum += leaflet[n];
        ++count;
      });
      if (count > 0) filled.emplace_back(cell, sum / count);
    }
    for (const auto &[cell, height] : filled) leaflet[cell] = height;
    front.clear();
    for (const auto &[cell, height] : filled) {
      for_each_around(cell, [&](size_t n) {
        if (listed[n] || !is_hole(n)) return;
        listed[n] = 1;
        front.push_back(n);
      });
    }
    // a cell that is listed now has a neighbour with a height, and is filled in the next round
  } while (!filled.empty());
}

}  // namespace

double AtrialSurface::rise(size_t cell) const {
  const double rise = heights[cell] - map->heights()[cell];
  return std::isfinite(rise) ? rise : 0;
}

AtrialSurface atrial_surface(const Model &model, const std::vector<Vec3> &x) {
  AtrialSurface surface;
  surface.frame = valve_frame(model, x);
  surface.local = surface.frame.local(x);
  surface.map = annulus_map(surface.frame, Loop(model.valve.annulus, x).points());
  const AnnulusMap &map = *surface.map;
  const double radius = 0.5 * model.valve.contact_thickness;
  surface.heights = highest_leaflet(map, model.valve.triangles, surface.local);
  surface.heights = roll_ball(map, roll_ball(map, surface.heights, radius, 1), radius, -1);
  fill_holes(map, surface.heights);
  return surface;
}

std::vector<double> node_rises(const Model &model, const AtrialSurface &atrial) {
  const AnnulusSurface &surface = atrial.map->surface();
  std::vector<double> rises(atrial.local.size(), std::numeric_limits<double>::quiet_NaN());
  size_t near = 0;
  const Rows &sheet = model.topology.node_triangles;
  for (size_t node = 0; node < rises.size(); ++node) {
    if (sheet.start[node] == sheet.start[node + 1]) continue;
    const Vec3 &p = atrial.local[node];
    rises[node] = p[2] - surface.height(p[0], p[1], near);
  }
  return rises;
}

}  // namespace mvs::core
