// Parts of the orifice by breadth-first search over shared points; the tissue beside each by the
// nearest triangle of the sheet to samples of the orifice.
#include "measure/regions/orifice_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "geometry/closest_nearby.h"
#include "measure/annulus/landmarks.h"
#include "measure/coaptation/coaptation_parts.h"
#include "measure/regions/region_search.h"

namespace mvs::core {
namespace {

// A region is beside a part if at least this share of the part's area is nearest to its tissue.
constexpr double beside = 0.05;
// Distance of samples over the contact thickness, and the most parts of a side of a triangle.
constexpr double spacing_of_thickness = 0.125;
constexpr double most_parts = 12;

Vec3 area_vector(const Orifice &orifice, uint32_t t) {
  const Tri &c = orifice.triangles[t];
  const std::vector<Vec3> &x = orifice.vertices;
  return 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
}

// Numbers the triangles connected over points; returns how many parts there are.
uint32_t number_parts(const Orifice &orifice, std::vector<uint32_t> &part_of) {
  const std::vector<Tri> &triangles = orifice.triangles;
  std::vector<std::vector<uint32_t>> around(orifice.vertices.size());
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    for (const uint32_t v : triangles[t]) around[v].push_back(t);
  }
  part_of.assign(triangles.size(), none);
  uint32_t parts = 0;
  for (uint32_t start = 0; start < triangles.size(); ++start) {
    if (part_of[start] != none) continue;
    std::vector<uint32_t> queue = {start};
    part_of[start] = parts;
    for (size_t q = 0; q < queue.size(); ++q) {
      for (const uint32_t v : triangles[queue[q]]) {
        for (const uint32_t t : around[v]) {
          if (part_of[t] != none) continue;
          part_of[t] = parts;
          queue.push_back(t);
        }
      }
    }
    ++parts;
  }
  return parts;
}

// Sets area, centroid and direction of each part.
void add_triangles(const Orifice &orifice, OrificeParts &found) {
  for (uint32_t t = 0; t < orifice.triangles.size(); ++t) {
    OrificePart &part = found.parts[found.of_triangle[t]];
    const Tri &c = orifice.triangles[t];
    const std::vector<Vec3> &x = orifice.vertices;
    const Vec3 vector = area_vector(orifice, t);
    ++part.triangles;
    part.area += vector.norm();
    part.centroid += vector.norm() * (x[c[0]] + x[c[1]] + x[c[2]]) / 3;
    part.direction += vector;
  }
  for (OrificePart &part : found.parts) {
    if (part.area > 0) part.centroid /= part.area;
    part.direction.normalize();
  }
}

// Sorts parts by area, the largest first, and numbers the triangles anew.
void sort_parts(OrificeParts &found) {
  std::vector<uint32_t> order(found.parts.size()), place(found.parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return found.parts[a].area > found.parts[b].area;
  });
  std::vector<OrificePart> sorted;
  for (uint32_t k = 0; k < order.size(); ++k) {
    place[order[k]] = k;
    sorted.push_back(found.parts[order[k]]);
  }
  found.parts = std::move(sorted);
  for (uint32_t &part : found.of_triangle) part = place[part];
}

// Distributes samples of the orifice to the regions of their nearest tissue, and looks for the
// widest ball of each part and region: only samples that may widen a gap look for their distance.
class OrificeSampling {
 public:
  OrificeSampling(const Model &model, const std::vector<Vec3> &x, const RegionMap &map,
                  const Orifice &orifice, OrificeParts &found)
      : map_(map),
        orifice_(orifice),
        found_(found),
        tree_(model.valve.triangles, x),
        search_(tree_, map),
        spacing_(spacing_of_thickness * model.valve.contact_thickness) {
    found.gap_of_region.assign(map.size(), 0);
  }

  void run() {
    std::vector<Piece> pieces;
    for (uint32_t t = 0; t < orifice_.triangles.size(); ++t) pieces.push_back(piece_of(t));
    std::vector<uint32_t> order(pieces.size());
    std::iota(order.begin(), order.end(), 0u);
    // the widest first, so that few of the others can widen a gap
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return pieces[a].widest > pieces[b].widest; });
    for (const uint32_t t : order) widen(found_.of_triangle[t], pieces[t]);
  }

 private:
  // A triangle of the orifice.
  struct Piece {
    Vec3 centre;
    double radius;  // m
    double widest;  // m: no ball around a sample is wider
    std::vector<Vec3> samples;
    std::vector<uint32_t> tissue;  // of the regions nearest to each
    uint32_t nearest;              // to the centre
  };

  Piece piece_of(uint32_t t) {
    const Tri &c = orifice_.triangles[t];
    const Vec3 &p = orifice_.vertices[c[0]], &q = orifice_.vertices[c[1]],
               &r = orifice_.vertices[c[2]];
    const double longest = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
    const auto parts =
        static_cast<size_t>(std::clamp(std::ceil(longest / spacing_), 1.0, most_parts));
    Piece piece;
    piece.centre = (p + q + r) / 3;
    piece.radius =
        std::max({(p - piece.centre).norm(), (q - piece.centre).norm(), (r - piece.centre).norm()});
    places_.clear();
    for_each_part(parts, [&](const std::array<double, 3> &w) {
      piece.samples.push_back(w[0] * p + w[1] * q + w[2] * r);
      places_.push_back({piece.samples.back(), piece.samples.size() - 1});
    });
    search_.find(places_);
    piece.tissue.resize(places_.size());
    for (const RegionPlace &place : places_) piece.tissue[place.index] = place.tissue;
    const TriangleBvh::Hit hit = tree_.closest(piece.centre, nearest_);
    nearest_ = piece.nearest = hit.triangle;
    piece.widest = 2 * (std::sqrt(hit.distance2) + piece.radius) * with_rounding;
    add_samples(t, area_vector(orifice_, t).norm() / static_cast<double>(parts * parts), piece);
    return piece;
  }

  void add_samples(uint32_t t, double area, const Piece &piece) {
    const size_t first = found_.samples.size();
    for (const uint32_t tissue : piece.tissue) {
      const bool is_new = found_.samples.size() == first ||
                          !map_.same_regions(found_.samples.back().tissue, tissue);
      if (is_new) found_.samples.push_back({area, 0, tissue, found_.of_triangle[t]});
      ++found_.samples.back().count;
    }
  }

  // The narrowest of the gaps that a sample may widen.
  double narrowest(uint32_t part, uint32_t tissue) const {
    double gap = found_.parts[part].gap;
    map_.for_each(tissue, [&](uint32_t r) { gap = std::min(gap, found_.gap_of_region[r]); });
    return gap;
  }

  void widen(uint32_t part, const Piece &piece) {
    std::optional<ClosestNearby> nearby;
    uint32_t nearest = piece.nearest;
    const double at_centre = piece.widest - 2 * piece.radius;
    for (size_t k = 0; k < piece.samples.size(); ++k) {
      const double off = (piece.samples[k] - piece.centre).norm();
      if ((at_centre + 2 * off) * with_rounding <= narrowest(part, piece.tissue[k])) continue;
      if (!nearby) nearby.emplace(tree_, piece.centre, piece.radius, nearest);
      const TriangleBvh::Hit hit = nearby->closest(piece.samples[k], nearest);
      nearest = hit.triangle;
      const double width = 2 * std::sqrt(hit.distance2);
      found_.parts[part].gap = std::max(found_.parts[part].gap, width);
      map_.for_each(piece.tissue[k], [&](uint32_t r) {
        found_.gap_of_region[r] = std::max(found_.gap_of_region[r], width);
      });
    }
  }

  // Above the rounding of the distances that a bound is compared with.
  static constexpr double with_rounding = 1 + 1e-9;

  const RegionMap &map_;
  const Orifice &orifice_;
  OrificeParts &found_;
  TriangleBvh tree_;
  RegionSearch search_;
  double spacing_;
  std::vector<RegionPlace> places_;
  uint32_t nearest_ = none;  // to the triangle before, most often near this one, too
};

void add_name(const std::string &name, std::string &names) {
  names += (names.empty() ? "" : "+") + name;
}

void name_sides(const Model &model, const RegionMap &map, OrificeParts &found) {
  std::vector<std::vector<double>> area(found.parts.size(), std::vector<double>(map.size()));
  for (const OrificeSamples &samples : found.samples) {
    map.for_each(samples.tissue, [&](uint32_t region) {
      for (size_t k = 0; k < samples.count; ++k) area[samples.part][region] += samples.area;
    });
  }
  const uint32_t anterior = anterior_leaflet(model.valve);
  for (size_t k = 0; k < found.parts.size(); ++k) {
    OrificePart &part = found.parts[k];
    for (size_t region = 0; region < map.size(); ++region) {
      if (area[k][region] < beside * part.area) continue;
      if (region >= map.scallops()) {
        add_name(map.name(region), part.commissures);
      } else if (model.valve.scallops[region].leaflet == anterior) {
        add_name(map.name(region), part.anterior);
      } else {
        add_name(map.name(region), part.posterior);
      }
    }
  }
}

}  // namespace

OrificeParts find_orifice_parts(const Model &model, const std::vector<Vec3> &x,
                                const RegionMap &map, const Orifice &orifice) {
  OrificeParts found;
  if (orifice.triangles.empty()) return found;
  found.parts.resize(number_parts(orifice, found.of_triangle));
  add_triangles(orifice, found);
  sort_parts(found);
  OrificeSampling(model, x, map, orifice, found).run();
  name_sides(model, map, found);
  return found;
}

}  // namespace mvs::core
