// Shares of places by the distances from the tissue of each region, and weighted means.
#include "measure/regions/line_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "geometry/bvh.h"

namespace mvs::core {
namespace {

// Places between two stations of a coaptation line: 0.13 mm apart in a default valve.
constexpr int places = 16;
// Difference of distances over the contact thickness at which a place belongs to one region only: a
// place of the line is 0.2 to 0.5 of it from tissue, so that shares change over half of it.
constexpr double ramp_of_thickness = 0.125;

// Some triangles, to find the distance of a point.
class Tissue {
 public:
  Tissue(std::vector<Tri> triangles, const std::vector<Vec3> &x)
      : triangles_(std::move(triangles)) {
    if (!triangles_.empty()) tree_.emplace(triangles_, x);
  }
  Tissue(const Tissue &) = delete;

  bool is_empty() const { return triangles_.empty(); }
  // Infinite without triangles.
  double distance(const Vec3 &p) {
    if (!tree_) return std::numeric_limits<double>::infinity();
    const TriangleBvh::Hit hit = tree_->closest(p, nearest_);
    nearest_ = hit.triangle;
    return std::sqrt(hit.distance2);
  }

 private:
  std::vector<Tri> triangles_;
  std::optional<TriangleBvh> tree_;
  uint32_t nearest_ = none;  // to the last point, most often near the next one, too
};

// The tissue of one leaflet by region.
class LeafletRegions {
 public:
  LeafletRegions(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                 uint32_t leaflet)
      : scallops_(map.scallops()), ramp_(ramp_of_thickness * model.valve.contact_thickness) {
    std::vector<std::vector<Tri>> inside(map.size()), outside(map.size());
    for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
      if (model.valve.triangle_leaflet[t] != leaflet) continue;
      std::vector<uint8_t> belongs(map.size(), 0);
      map.for_each(t, [&](uint32_t region) { belongs[region] = 1; });
      for (size_t r = 0; r < map.size(); ++r) {
        (belongs[r] ? inside : outside)[r].push_back(model.valve.triangles[t]);
      }
    }
    for (size_t r = 0; r < map.size(); ++r) {
      const bool is_scallop = r < scallops_;
      inside_.push_back(std::make_unique<Tissue>(std::move(inside[r]), x));
      // the rest of the leaflet is the other scallops
      outside_.push_back(
          std::make_unique<Tissue>(is_scallop ? std::vector<Tri>() : std::move(outside[r]), x));
    }
  }

  // The share of a place that belongs to each region.
  std::vector<double> shares(const Vec3 &p) {
    std::vector<double> near(inside_.size()), shares(inside_.size(), 0);
    for (size_t r = 0; r < near.size(); ++r) near[r] = inside_[r]->distance(p);
    for (size_t r = 0; r < near.size(); ++r) {
      if (inside_[r]->is_empty()) continue;
      double other = outside_[r]->distance(p);
      for (size_t k = 0; r < scallops_ && k < scallops_; ++k) {
        if (k != r) other = std::min(other, near[k]);
      }
      shares[r] = std::clamp(0.5 + (other - near[r]) / (2 * ramp_), 0.0, 1.0);
    }
    return shares;
  }

 private:
  size_t scallops_;
  double ramp_;
  std::vector<std::unique_ptr<Tissue>> inside_, outside_;
};

// A place of the line in a region: its share of the line there, m, and the coaptation length.
struct Place {
  double share, along, length;
};

void write(const std::vector<Place> &line, RegionMeasures &measures) {
  double along = 0, area = 0;
  for (const Place &p : line) {
    along += p.share * p.along;
    area += p.share * p.along * p.length;
  }
  if (!(along > 0)) return;
  const double mean = area / along;
  measures.coaptation_length_mean = mean;
  measures.coaptation_length_min = mean;
  // a place that leaves the region counts as ever nearer to the mean
  for (const Place &p : line) {
    measures.coaptation_length_min =
        std::min(measures.coaptation_length_min, mean + p.share * (p.length - mean));
  }
}

}  // namespace

void add_coaptation_lengths(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                            const Coaptation &coaptation, std::vector<RegionMeasures> &measures) {
  std::vector<std::vector<Place>> found(map.size());
  uint32_t begin = 0;
  for (size_t line = 0; line < coaptation.line_end.size(); ++line) {
    const uint32_t end = coaptation.line_end[line];
    std::vector<uint32_t> sides(coaptation.line_leaflets[line].begin(),
                                coaptation.line_leaflets[line].end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    for (const uint32_t leaflet : sides) {
      LeafletRegions regions(model, x, map, leaflet);
      for (uint32_t k = begin; k + 1 < end; ++k) {
        const CoaptationStation &a = coaptation.line[k], &b = coaptation.line[k + 1];
        const double along = (b.point - a.point).norm() / places;
        for (int i = 0; i < places; ++i) {
          const double at = (i + 0.5) / places;
          const std::vector<double> shares = regions.shares(a.point + at * (b.point - a.point));
          const double length = a.length + at * (b.length - a.length);
          for (size_t r = 0; r < shares.size(); ++r) {
            if (shares[r] > 0) found[r].push_back({shares[r], along, length});
          }
        }
      }
    }
    begin = end;
  }
  for (size_t r = 0; r < found.size(); ++r) write(found[r], measures[r]);
}

}  // namespace mvs::core
