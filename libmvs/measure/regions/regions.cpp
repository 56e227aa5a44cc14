// Distributes the samples of the whole-valve measures to regions: each sample belongs to the
// region of its triangle, or of the triangle nearest to it.
#include "measure/regions/regions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/closest_nearby.h"
#include "measure/regions/line_regions.h"
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

// Cells of a side of the largest blocks.
constexpr int largest_block = 32;

// Finds tissue of the regions to which the tissue closest to each cell belongs. Where all triangles
// that can be closest to any cell of a block belong to the same regions, the block is done; else
// its quarters look among these triangles, down to single cells.
class CellTissue {
 public:
  CellTissue(const Model &model, const AtrialSurface &atrial, const RegionMap &map)
      : atrial_(atrial),
        map_(map),
        tree_(model.valve.triangles, atrial.local),
        tissue_(atrial.heights.size(), none) {}

  // A triangle for each cell; `none` for cells that are not measured.
  std::vector<uint32_t> find() {
    for (int row = 0; row < AnnulusMap::across; row += largest_block) {
      for (int column = 0; column < AnnulusMap::across; column += largest_block) {
        if (!collect({column, row, largest_block})) continue;
        const ClosestNearby near(tree_, centre_, radius_, nearest_);
        nearest_ = near.closest_to_centre();
        fill({column, row, largest_block}, near.triangles(), 0);
      }
    }
    return std::move(tissue_);
  }

 private:
  struct Block {
    int column, row, side;
  };
  struct Near {
    uint32_t triangle;
    double distance2;
  };

  // The measured cells of a block, and a ball around one of them that holds all; returns whether
  // there are any.
  bool collect(const Block &block) {
    cells_.clear();
    places_.clear();
    const AnnulusMap &map = *atrial_.map;
    for (int row = block.row; row < block.row + block.side; ++row) {
      for (int column = block.column; column < block.column + block.side; ++column) {
        const size_t cell = AnnulusMap::at(column, row);
        const double height = atrial_.heights[cell];
        if (!map.inside(cell) || !std::isfinite(height)) continue;
        cells_.push_back(cell);
        places_.push_back(
            {map.u()[static_cast<size_t>(column)], map.v()[static_cast<size_t>(row)], height});
      }
    }
    if (cells_.empty()) return false;
    const size_t middle = (cells_.size() + static_cast<size_t>(block.side)) / 2;
    centre_ = places_[std::min(middle, places_.size() - 1)];
    double radius2 = 0;
    for (const Vec3 &p : places_) radius2 = std::max(radius2, (p - centre_).squaredNorm());
    radius_ = std::sqrt(radius2);
    return true;
  }

  // Keeps the triangles that can be closest to a point of the ball, and the closest to its centre.
  // The closest to any of its points is at most twice the radius further from the centre than that.
  void narrow(const std::vector<uint32_t> &among, std::vector<Near> &near) {
    near.clear();
    double least = HUGE_VAL, limit2 = HUGE_VAL;
    for (const uint32_t t : among) {
      if (tree_.box_of(t).distance2(centre_) > limit2) continue;
      const double distance2 = tree_.closest_on(t, centre_).distance2;
      if (distance2 > limit2) continue;
      near.push_back({t, distance2});
      if (distance2 > least || (distance2 == least && t > nearest_)) continue;
      least = distance2;
      nearest_ = t;
      const double limit = (std::sqrt(least) + 2 * radius_) * (1 + 1e-9);  // above rounding
      limit2 = limit * limit;
    }
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](const Near &n) { return n.distance2 > limit2; }),
               near.end());
  }

  void fill(const Block &block, const std::vector<uint32_t> &among, size_t depth) {
    narrow(among, near_);
    const bool is_of_one = std::all_of(near_.begin(), near_.end(), [&](const Near &n) {
      return map_.same_regions(n.triangle, nearest_);
    });
    if (is_of_one || block.side == 1) {
      for (const size_t cell : cells_) tissue_[cell] = nearest_;
      return;
    }
    std::vector<uint32_t> &left = left_[depth];
    left.clear();
    for (const Near &n : near_) left.push_back(n.triangle);
    const int half = block.side / 2;
    for (const int down : {0, half}) {
      for (const int across : {0, half}) {
        const Block quarter = {block.column + across, block.row + down, half};
        if (collect(quarter)) fill(quarter, left, depth + 1);
      }
    }
  }

  const AtrialSurface &atrial_;
  const RegionMap &map_;
  TriangleBvh tree_;
  std::vector<uint32_t> tissue_;
  uint32_t nearest_ = none;  // to the centre of the last block
  // of the present block
  std::vector<size_t> cells_;
  std::vector<Vec3> places_;  // of the cells, in the frame of the valve
  Vec3 centre_;
  double radius_ = 0;
  std::vector<Near> near_;
  std::array<std::vector<uint32_t>, 8> left_;  // by depth: triangles left for the quarters
};
static_assert(AnnulusMap::across % largest_block == 0 && largest_block < 1 << 8);

void add_tenting_billow(const Model &model, const AtrialSurface &atrial, const RegionMap &map,
                        std::vector<RegionMeasures> &measures) {
  const std::vector<uint32_t> tissue = CellTissue(model, atrial, map).find();
  for (size_t cell = 0; cell < tissue.size(); ++cell) {
    if (tissue[cell] == none) continue;
    const double rise = atrial.rise(cell), depth = -atrial.map->share(cell) * atrial.heights[cell];
    map.for_each(tissue[cell], [&](uint32_t region) {
      RegionMeasures &m = measures[region];
      m.tenting_height = std::max(m.tenting_height, depth);
      m.tenting_volume += atrial.area(cell) * std::max(0.0, -rise);
      m.billow_volume += atrial.area(cell) * std::max(0.0, rise);
    });
  }
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
