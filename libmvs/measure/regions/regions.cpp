// Distributes the samples of the whole-valve measures to regions: each sample belongs to the
// region of its triangle, or of the triangle nearest to it.
#include "measure/regions/regions.h"

#include <algorithm>
#include <cmath>

#include "geometry/bvh.h"
#include "measure/regions/line_regions.h"
#include "measure/tenting/atrial_surface.h"
#include "measure/tissue/surface.h"

namespace mvs::core {
namespace {

void add_areas(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
               const Coaptation &coaptation, std::vector<RegionMeasures> &measures) {
  const Surface surface = surface_of(model.valve.triangles, x);
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    const double area = 0.5 * surface.area[t] * coaptation.share[t];
    map.for_each(t, [&](uint32_t region) { measures[region].coaptation_area += area; });
  }
}

void add_orifice(const RegionMap &map, const OrificeParts &orifice,
                 std::vector<RegionMeasures> &measures) {
  for (const OrificeSample &sample : orifice.samples) {
    map.for_each(sample.tissue, [&](uint32_t region) {
      measures[region].orifice_area += sample.area;
      measures[region].gap = std::max(measures[region].gap, sample.width);
    });
  }
}

void add_tenting_billow(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                        std::vector<RegionMeasures> &measures) {
  const AtrialSurface atrial = atrial_surface(model, x);
  const std::vector<Tri> &sheet = model.valve.triangles;
  const TriangleBvh tree(sheet, atrial.local);
  for (int row = 0; row < AnnulusMap::across; ++row) {
    for (int column = 0; column < AnnulusMap::across; ++column) {
      const size_t cell = AnnulusMap::at(column, row);
      const double height = atrial.heights[cell];
      if (!atrial.map->inside(cell) || !std::isfinite(height)) continue;
      const Vec3 p(atrial.map->u()[static_cast<size_t>(column)],
                   atrial.map->v()[static_cast<size_t>(row)], height);
      const double rise = atrial.rise(cell);
      map.for_each(tree.closest(p).triangle, [&](uint32_t region) {
        RegionMeasures &m = measures[region];
        m.tenting_height = std::max(m.tenting_height, -atrial.map->share(cell) * height);
        m.tenting_volume += atrial.area(cell) * std::max(0.0, -rise);
        m.billow_volume += atrial.area(cell) * std::max(0.0, rise);
      });
    }
  }
  const std::vector<double> rises = node_rises(model, atrial);
  for (uint32_t t = 0; t < sheet.size(); ++t) {
    map.for_each(t, [&](uint32_t region) {
      double &highest = measures[region].billow_height;
      for (const uint32_t node : sheet[t]) {
        if (rises[node] > highest) highest = rises[node];  // false for NaN
      }
    });
  }
}

}  // namespace

std::vector<RegionMeasures> measure_regions(const Model &model, const std::vector<Vec3> &x,
                                            const RegionMap &map, const Coaptation &coaptation,
                                            const OrificeParts &orifice) {
  std::vector<RegionMeasures> measures(map.size());
  add_areas(model, x, map, coaptation, measures);
  add_coaptation_lengths(model, x, map, coaptation, measures);
  add_orifice(map, orifice, measures);
  add_tenting_billow(model, x, map, measures);
  return measures;
}

}  // namespace mvs::core
