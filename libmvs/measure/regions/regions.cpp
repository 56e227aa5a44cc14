// Distributes the samples of the whole-valve measures to regions: each sample belongs to the
// region of its triangle, or of the triangle nearest to it.
#include "measure/regions/regions.h"

#include <algorithm>
#include <cmath>

#include "measure/regions/line_regions.h"
#include "measure/regions/region_depths.h"
#include "measure/regions/region_search.h"
#include "measure/tissue/sheet_topology.h"
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
  for (const OrificeSamples &samples : orifice.samples) {
    map.for_each(samples.tissue, [&](uint32_t region) {
      for (size_t k = 0; k < samples.count; ++k) measures[region].orifice_area += samples.area;
    });
  }
  for (size_t r = 0; r < orifice.gap_of_region.size(); ++r) {
    measures[r].gap = orifice.gap_of_region[r];
  }
}

// Cells of a side of a block, which look for their tissue together.
constexpr int block = 32;
static_assert(AnnulusMap::across % block == 0);

// The measured cells of a block, in the frame of the valve.
void list_cells(const AtrialSurface &atrial, int first_column, int first_row,
                std::vector<RegionPlace> &cells) {
  cells.clear();
  const AnnulusMap &map = *atrial.map;
  for (int row = first_row; row < first_row + block; ++row) {
    for (int column = first_column; column < first_column + block; ++column) {
      const size_t cell = AnnulusMap::at(column, row);
      const double height = atrial.heights[cell];
      if (!map.inside(cell) || !std::isfinite(height)) continue;
      cells.push_back(
          {{map.u()[static_cast<size_t>(column)], map.v()[static_cast<size_t>(row)], height},
           cell});
    }
  }
}

// Tissue of the regions closest to each cell; `none` for cells that are not measured.
std::vector<uint32_t> tissue_of_cells(const AtrialSurface &atrial, const RegionMap &map,
                                      const TriangleBvh &tree) {
  std::vector<uint32_t> tissue(atrial.heights.size(), none);
  RegionSearch search(tree, map);
  std::vector<RegionPlace> cells;
  for (int row = 0; row < AnnulusMap::across; row += block) {
    for (int column = 0; column < AnnulusMap::across; column += block) {
      list_cells(atrial, column, row, cells);
      search.find(cells);
      for (const RegionPlace &cell : cells) tissue[cell.index] = cell.tissue;
    }
  }
  return tissue;
}

void add_tenting_billow(const Model &model, const AtrialSurface &atrial, const RegionMap &map,
                        std::vector<RegionMeasures> &measures) {
  const TriangleBvh tree(model.valve.triangles, atrial.local, *sheet_topology(model));
  const std::vector<uint32_t> tissue = tissue_of_cells(atrial, map, tree);
  std::vector<double> deepest(map.size(), 0);
  for (size_t cell = 0; cell < tissue.size(); ++cell) {
    if (tissue[cell] == none) continue;
    const double rise = atrial.rise(cell), depth = atrial.depth(cell);
    map.for_each(tissue[cell], [&](uint32_t region) {
      RegionMeasures &m = measures[region];
      deepest[region] = std::max(deepest[region], depth);
      m.tenting_volume += atrial.area(cell) * std::max(0.0, -rise);
      m.billow_volume += atrial.area(cell) * std::max(0.0, rise);
    });
  }
  raise_depths(atrial, map, tree, model.valve.contact_thickness, deepest);
  for (size_t r = 0; r < deepest.size(); ++r) measures[r].tenting_height = deepest[r];
  const std::vector<Tri> &sheet = model.valve.triangles;
  for (uint32_t t = 0; t < sheet.size(); ++t) {
    map.for_each(t, [&](uint32_t region) {
      double &highest = measures[region].billow_height;
      for (const uint32_t node : sheet[t]) {
        if (atrial.node_rise[node] > highest) highest = atrial.node_rise[node];  // false for NaN
      }
    });
  }
}

}  // namespace

std::vector<RegionMeasures> measure_regions(const Model &model, const std::vector<Vec3> &x,
                                            const RegionMap &map, const Coaptation &coaptation,
                                            const OrificeParts &orifice,
                                            const AtrialSurface &atrial) {
  std::vector<RegionMeasures> measures(map.size());
  add_areas(model, x, map, coaptation, measures);
  add_coaptation_lengths(model, x, map, coaptation, measures);
  add_orifice(map, orifice, measures);
  add_tenting_billow(model, atrial, map, measures);
  return measures;
}

}  // namespace mvs::core
