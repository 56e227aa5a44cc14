// Parts of the orifice by breadth-first search over shared edges; the tissue beside each by the
// nearest triangle of the sheet to samples of the orifice.
#include "measure/regions/orifice_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/closest_nearby.h"
#include "measure/annulus/landmarks.h"
#include "measure/coaptation/coaptation_parts.h"
#include "model/sides.h"

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

// Numbers the triangles connected over edges; returns how many parts there are.
uint32_t number_parts(const std::vector<Tri> &triangles, std::vector<uint32_t> &part_of) {
  std::vector<std::vector<uint32_t>> next(triangles.size());
  const std::vector<Side> sides = sorted_sides(triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    for (size_t k = first + 1; k < last; ++k) {
      next[sides[k - 1].triangle].push_back(sides[k].triangle);
      next[sides[k].triangle].push_back(sides[k - 1].triangle);
    }
  });
  part_of.assign(triangles.size(), none);
  uint32_t parts = 0;
  for (uint32_t start = 0; start < triangles.size(); ++start) {
    if (part_of[start] != none) continue;
    std::vector<uint32_t> queue = {start};
    part_of[start] = parts;
    for (size_t q = 0; q < queue.size(); ++q) {
      for (const uint32_t t : next[queue[q]]) {
        if (part_of[t] != none) continue;
        part_of[t] = parts;
        queue.push_back(t);
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

void sample_orifice(const Model &model, const std::vector<Vec3> &x, const Orifice &orifice,
                    OrificeParts &found) {
  const TriangleBvh tree(model.valve.triangles, x);
  const double spacing = spacing_of_thickness * model.valve.contact_thickness;
  uint32_t nearest = none;  // to the sample before, most often near this one, too
  for (uint32_t t = 0; t < orifice.triangles.size(); ++t) {
    const Tri &c = orifice.triangles[t];
    const Vec3 &p = orifice.vertices[c[0]], &q = orifice.vertices[c[1]],
               &r = orifice.vertices[c[2]];
    const double longest = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
    const auto parts =
        static_cast<size_t>(std::clamp(std::ceil(longest / spacing), 1.0, most_parts));
    const double area = area_vector(orifice, t).norm() / static_cast<double>(parts * parts);
    const Vec3 centre = (p + q + r) / 3;
    const double radius = std::max({(p - centre).norm(), (q - centre).norm(), (r - centre).norm()});
    const ClosestNearby tissue(tree, centre, radius, nearest);
    nearest = tissue.closest_to_centre();
    for_each_part(parts, [&](const std::array<double, 3> &w) {
      const TriangleBvh::Hit hit = tissue.closest(w[0] * p + w[1] * q + w[2] * r, nearest);
      nearest = hit.triangle;
      const double width = 2 * std::sqrt(hit.distance2);
      found.samples.push_back({area, width, hit.triangle, found.of_triangle[t]});
      OrificePart &part = found.parts[found.of_triangle[t]];
      part.gap = std::max(part.gap, width);
    });
  }
}

void add_name(const std::string &name, std::string &names) {
  names += (names.empty() ? "" : "+") + name;
}

void name_sides(const Model &model, const RegionMap &map, OrificeParts &found) {
  std::vector<std::vector<double>> area(found.parts.size(), std::vector<double>(map.size()));
  for (const OrificeSample &sample : found.samples) {
    map.for_each(sample.tissue, [&](uint32_t region) { area[sample.part][region] += sample.area; });
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
  found.parts.resize(number_parts(orifice.triangles, found.of_triangle));
  add_triangles(orifice, found);
  sort_parts(found);
  sample_orifice(model, x, orifice, found);
  name_sides(model, map, found);
  return found;
}

}  // namespace mvs::core
