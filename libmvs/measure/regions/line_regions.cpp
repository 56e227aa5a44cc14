// Shares of places by the distances from the tissue of each region, and weighted means.
#include "measure/regions/line_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/triangle_bvh.h"

namespace mvs::core {
namespace {

// Places between two stations of the profile of a coaptation line: 0.13 mm apart in a default
// valve.
constexpr int places = 4;
// Difference of distances over the contact thickness at which a place belongs to one region only: a
// place of the line is 0.2 to 0.5 of it from tissue, so that shares change over half of it.
constexpr double ramp_of_thickness = 0.125;

// The tissue of one leaflet by region.
class LeafletRegions {
 public:
  LeafletRegions(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                 uint32_t leaflet)
      : map_(map),
        ramp_(ramp_of_thickness * model.valve.contact_thickness),
        exists_(map.size(), 0),
        inside_(map.size()),
        outside_(map.size()) {
    for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
      if (model.valve.triangle_leaflet[t] != leaflet) continue;
      map.for_each(t, [&](uint32_t region) { exists_[region] = 1; });
      number_.push_back(t);
      triangles_.push_back(model.valve.triangles[t]);
    }
    tree_.emplace(triangles_, x);
  }
  LeafletRegions(const LeafletRegions &) = delete;  // the tree refers to another member

  // The share of a place that belongs to each region. Tissue further than the ramp beyond the
  // nearest makes shares of 0 and 1 alone: it is not looked at.
  const std::vector<double> &shares(const Vec3 &p) {
    constexpr double nothing = std::numeric_limits<double>::infinity();
    inside_.assign(inside_.size(), nothing);
    outside_.assign(outside_.size(), nothing);
    const TriangleBvh::Hit hit = tree_->closest(p, nearest_);
    nearest_ = hit.triangle;
    const double limit = (std::sqrt(hit.distance2) + ramp_) * (1 + 1e-9);  // above rounding
    const double limit2 = limit * limit;
    tree_->visit_near(p, limit2, [&](uint32_t t) {
      if (tree_->box_of(t).distance2(p) > limit2) return;
      add(number_[t], tree_->closest_on(t, p).distance2);
    });
    shares_.assign(inside_.size(), 0);
    for (size_t r = 0; r < shares_.size(); ++r) {
      if (exists_[r] == 0 || inside_[r] == nothing) continue;
      const double near = std::sqrt(inside_[r]), other = std::sqrt(outside_[r]);
      shares_[r] = std::clamp(0.5 + (other - near) / (2 * ramp_), 0.0, 1.0);
    }
    return shares_;
  }

 private:
  // Lowers the squared distances for a triangle: from its regions, and from the rest of the
  // leaflet for all others.
  void add(uint32_t triangle, double distance2) {
    belongs_.assign(inside_.size(), 0);
    map_.for_each(triangle, [&](uint32_t region) { belongs_[region] = 1; });
    for (size_t r = 0; r < inside_.size(); ++r) {
      double &least = belongs_[r] != 0 ? inside_[r] : outside_[r];
      least = std::min(least, distance2);
    }
  }

  const RegionMap &map_;
  double ramp_;
  std::vector<uint32_t> number_;  // of each triangle in the model
  std::vector<Tri> triangles_;
  std::optional<TriangleBvh> tree_;
  uint32_t nearest_ = none;  // to the last point, most often near the next one, too
  // Per region: whether the leaflet has tissue of it, and squared distances from it and the rest.
  std::vector<uint8_t> exists_, belongs_;
  std::vector<double> inside_, outside_, shares_;
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
  for (size_t line = 0; line < coaptation.profile.size(); ++line) {
    const std::vector<CoaptationStation> &profile = coaptation.profile[line];
    std::vector<uint32_t> sides(coaptation.line_leaflets[line].begin(),
                                coaptation.line_leaflets[line].end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    for (const uint32_t leaflet : sides) {
      LeafletRegions regions(model, x, map, leaflet);
      for (size_t k = 0; k + 1 < profile.size(); ++k) {
        const CoaptationStation &a = profile[k], &b = profile[k + 1];
        const double along = (b.point - a.point).norm() / places;
        for (int i = 0; i < places; ++i) {
          const double at = (i + 0.5) / places;
          const std::vector<double> &shares = regions.shares(a.point + at * (b.point - a.point));
          const double length = a.length + at * (b.length - a.length);
          for (size_t r = 0; r < shares.size(); ++r) {
            if (shares[r] > 0) found[r].push_back({shares[r], along, length});
          }
        }
      }
    }
  }
  for (size_t r = 0; r < found.size(); ++r) write(found[r], measures[r]);
}

}  // namespace mvs::core
