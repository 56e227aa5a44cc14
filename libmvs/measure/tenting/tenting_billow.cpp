// Tenting and billow from a raster of the leaflets seen from the atrium, closed morphologically by
// a ball of the contact thickness, minus the surface that spans the annulus.
#include "measure/tenting/tenting_billow.h"

#include <algorithm>
#include <cmath>

#include "measure/annulus/annulus_map.h"
#include "measure/annulus/frame.h"
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

// Height of the leaflets above the annulus surface; 0 if either is not defined.
double rise_at(const AnnulusMap &map, const std::vector<double> &leaflet, size_t cell) {
  const double rise = leaflet[cell] - map.heights()[cell];
  return std::isfinite(rise) ? rise : 0;
}

double area_below(const AnnulusMap &map, const std::vector<double> &leaflet, int row) {
  double sum = 0;
  for (int column = 0; column < AnnulusMap::across; ++column) {
    sum += map.width() * std::max(0.0, -rise_at(map, leaflet, AnnulusMap::at(column, row)));
  }
  return sum;
}

// Area below the annulus surface in the central AP plane, interpolated between the adjacent rows.
double central_area_below(const AnnulusMap &map, const std::vector<double> &leaflet) {
  const double place = std::clamp(-map.low_v() / map.depth() - 0.5, 0.0, AnnulusMap::across - 2.0);
  const int row = static_cast<int>(place);
  const double share = place - row;
  return (1 - share) * area_below(map, leaflet, row) + share * area_below(map, leaflet, row + 1);
}

double highest_over(const AnnulusSurface &surface, const Model &model,
                    const std::vector<Vec3> &local) {
  double highest = 0;
  size_t near = 0;
  const Rows &sheet = model.topology.node_triangles;
  for (size_t node = 0; node < local.size(); ++node) {
    if (sheet.start[node] == sheet.start[node + 1]) continue;
    const Vec3 &p = local[node];
    const double rise = p[2] - surface.height(p[0], p[1], near);
    if (rise > highest) highest = rise;
  }
  return highest;
}

}  // namespace

TentingBillow measure_tenting_billow(const Model &model, const std::vector<Vec3> &x) {
  const Frame frame = valve_frame(model, x);
  const std::vector<Vec3> local = frame.local(x);
  const auto shared = annulus_map(frame, Loop(model.valve.annulus, x).points());
  const AnnulusMap &map = *shared;
  const double radius = 0.5 * model.valve.contact_thickness;
  std::vector<double> leaflet = highest_leaflet(map, model.valve.triangles, local);
  leaflet = roll_ball(map, roll_ball(map, leaflet, radius, 1), radius, -1);
  fill_holes(map, leaflet);

  TentingBillow result;
  const double cell = map.width() * map.depth();
  for (size_t c = 0; c < leaflet.size(); ++c) {
    if (!map.inside(c)) continue;
    const double rise = rise_at(map, leaflet, c);
    result.tenting_volume += cell * std::max(0.0, -rise);
    result.billow_volume += cell * std::max(0.0, rise);
    if (std::isfinite(leaflet[c])) {
      result.tenting_height = std::max(result.tenting_height, -leaflet[c]);
    }
  }
  result.tenting_area = central_area_below(map, leaflet);
  result.billow_height = highest_over(map.surface(), model, local);
  return result;
}

}  // namespace mvs::core
