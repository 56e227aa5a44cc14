// Distributes the samples of the whole-valve measures to regions: each sample belongs to the
// region of its triangle, or of the triangle nearest to it.
#include "measure/regions/regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/bvh.h"
#include "measure/tenting/atrial_surface.h"
#include "measure/tissue/surface.h"

namespace mvs::core {
namespace {

// Places between two stations of a coaptation line: 0.13 mm apart in a default valve.
constexpr int places = 16;

// The triangles of one leaflet, to find the one nearest to a point.
class LeafletTree {
 public:
  LeafletTree(const Model &model, const std::vector<Vec3> &x, uint32_t leaflet)
      : index_(indices_of(model, leaflet)), triangles_(triangles_of(model, index_)) {
    tree_.emplace(triangles_, x);
  }
  LeafletTree(const LeafletTree &) = delete;
  uint32_t nearest(const Vec3 &p) const { return index_[tree_->closest(p).triangle]; }

 private:
  static std::vector<uint32_t> indices_of(const Model &model, uint32_t leaflet) {
    std::vector<uint32_t> index;
    for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
      if (model.valve.triangle_leaflet[t] == leaflet) index.push_back(t);
    }
    return index;
  }
  static std::vector<Tri> triangles_of(const Model &model, const std::vector<uint32_t> &index) {
    std::vector<Tri> triangles;
    triangles.reserve(index.size());
    for (const uint32_t t : index) triangles.push_back(model.valve.triangles[t]);
    return triangles;
  }

  std::vector<uint32_t> index_;
  std::vector<Tri> triangles_;
  std::optional<TriangleBvh> tree_;
};

void add_areas(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
               const Coaptation &coaptation, std::vector<RegionMeasures> &measures) {
  const Surface surface = surface_of(model.valve.triangles, x);
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    const double area = 0.5 * surface.area[t] * coaptation.share[t];
    map.for_each(t, [&](uint32_t region) { measures[region].coaptation_area += area; });
  }
}

// Collects the coaptation length at places along the lines for each region.
class Lengths {
 public:
  explicit Lengths(size_t regions) : of_(regions) {}

  // A place with its share of the line, m.
  void add(uint32_t region, double along, double length) {
    Sum &sum = of_[region];
    sum.along += along;
    sum.area += along * length;
    sum.least = std::min(sum.least, length);
  }
  void write(std::vector<RegionMeasures> &measures) const {
    for (size_t region = 0; region < of_.size(); ++region) {
      const Sum &sum = of_[region];
      if (!(sum.along > 0)) continue;
      measures[region].coaptation_length_mean = sum.area / sum.along;
      measures[region].coaptation_length_min = sum.least;
    }
  }

 private:
  struct Sum {
    double along = 0, area = 0, least = std::numeric_limits<double>::infinity();
  };
  std::vector<Sum> of_;
};

void add_lengths(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                 const Coaptation &coaptation, std::vector<RegionMeasures> &measures) {
  Lengths lengths(measures.size());
  uint32_t begin = 0;
  for (size_t line = 0; line < coaptation.line_end.size(); ++line) {
    const uint32_t end = coaptation.line_end[line];
    std::vector<uint32_t> sides(coaptation.line_leaflets[line].begin(),
                                coaptation.line_leaflets[line].end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    for (const uint32_t leaflet : sides) {
      const LeafletTree tree(model, x, leaflet);
      for (uint32_t k = begin; k + 1 < end; ++k) {
        const CoaptationStation &a = coaptation.line[k], &b = coaptation.line[k + 1];
        const double along = (b.point - a.point).norm() / places;
        for (int i = 0; i < places; ++i) {
          const double share = (i + 0.5) / places;
          const uint32_t t = tree.nearest(a.point + share * (b.point - a.point));
          const double length = a.length + share * (b.length - a.length);
          map.for_each(t, [&](uint32_t region) { lengths.add(region, along, length); });
        }
      }
    }
    begin = end;
  }
  lengths.write(measures);
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
  add_lengths(model, x, map, coaptation, measures);
  add_orifice(map, orifice, measures);
  add_tenting_billow(model, x, map, measures);
  return measures;
}

}  // namespace mvs::core
