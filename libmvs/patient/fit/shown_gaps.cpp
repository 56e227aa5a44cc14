// The orifice of a surface together with the tissue that is there for certain.
#include "patient/fit/shown_gaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/median.h"
#include "measure/orifice/orifice.h"
#include "measure/regions/orifice_parts.h"
#include "model/sides.h"
#include "patient/fit/closed_pieces.h"
#include "patient/fit/leaflet_reach.h"

namespace mvs::core {
namespace {

// m, from the annulus: surfaces of images may end short of it, and leaflets do not part there.
constexpr double annulus_band = 4e-3;
// m, from the free edge of the valve at rest: 8 mm of leaflets that coapt normally overlap.
constexpr double from_free_edge = 10e-3;
// Effects of errors of the edges, by the standard deviation of places of the surface.
struct EdgeErrors {
  // m, 95 % of the difference of two edges: 1.96 times 1.41 deviations.
  double width;
  double least_width;  // m, of gaps that count
  // m2: in labels of networks, whose deviation is the usual one, gaps of sealed phantoms span less
  // together. False gaps are as wide as the errors, and no longer if these are smaller.
  double least_area;

  EdgeErrors(double deviation, double thickness)
      : width(2.8 * deviation),
        least_width(least_gap_width(deviation, thickness)),
        least_area(12e-6 * deviation / usual_closed_error) {}
};
// A piece of the surface is one leaflet if so much of it is; a gap is between leaflets, and no hole
// in one, if at least so much of it is nearer to another one.
constexpr double share_of_piece = 0.8, share_of_other = 0.2;
// m: a gap does not count where leaflets with the tissue that is missing beside it would overlap by
// so much. In labels of networks they would by 2.6 to 3.1 mm at false gaps of sealed phantoms, by
// 0.6 mm and less at gaps of torn chordae. A leaflet is beside a gap if this share of it is nearest
// to a rim of that leaflet.
constexpr double closed_overlap = 1.5e-3, share_of_rim = 0.2;

Vec3 middle_of(const std::vector<Vec3> &x, const Tri &t) {
  return (x[t[0]] + x[t[1]] + x[t[2]]) / 3;
}

// The leaflet of each triangle of the surface: that of its piece, or, where a piece has several
// leaflets, that of the nearest tissue of the valve.
std::vector<uint32_t> leaflets_of(const ClosedSurface &given, const ClosedPieces &pieces,
                                  const Model &model, const std::vector<Vec3> &x) {
  const size_t leaflets = model.valve.leaflets.size();
  const TriangleBvh valve(model.valve.triangles, x);
  std::vector<uint32_t> leaflet;
  std::vector<double> area(pieces.count * leaflets, 0);  // m2, of each piece near each leaflet
  for (size_t t = 0; t < given.triangles.size(); ++t) {
    const Tri &c = given.triangles[t];
    const TriangleBvh::Hit hit = valve.closest(middle_of(given.points, c));
    leaflet.push_back(model.valve.triangle_leaflet[hit.triangle]);
    area[pieces.of_triangle[t] * leaflets + leaflet[t]] += triangle_area(given.points, c);
  }
  for (size_t t = 0; t < leaflet.size(); ++t) {
    const auto first = area.begin() + static_cast<ptrdiff_t>(pieces.of_triangle[t] * leaflets);
    const auto last = first + static_cast<ptrdiff_t>(leaflets),
               most = std::max_element(first, last);
    if (*most > share_of_piece * std::accumulate(first, last, 0.0)) {
      leaflet[t] = static_cast<uint32_t>(most - first);
    }
  }
  return leaflet;
}

// Triangles with common corners where they meet, and none without area.
LeafletTriangles tissue_of(const ClosedSurface &given, const Model &model,
                           const std::vector<Vec3> &x) {
  const ClosedPieces pieces = closed_pieces(given.points, given.triangles);
  const std::vector<uint32_t> leaflet = leaflets_of(given, pieces, model, x);
  LeafletTriangles tissue;
  tissue.points = given.points;
  for (size_t k = 0; k < given.triangles.size(); ++k) {
    const Tri corners = pieces.joined(given.triangles[k]);
    if (!(triangle_area(given.points, corners) > 0)) continue;
    tissue.triangles.push_back(corners);
    tissue.leaflet.push_back(leaflet[k]);
  }
  return tissue;
}

void add_certain(const Model &model, const std::vector<Vec3> &x, const PatientGeometry &g,
                 LeafletTriangles &tissue) {
  const SheetCoordinates &at = g.coordinates;
  const auto is_certain = [&](uint32_t i) {
    return at.height[i] <= annulus_band || at.whole[i] - at.height[i] >= from_free_edge;
  };
  const auto offset = static_cast<uint32_t>(tissue.points.size());
  for (size_t k = 0; k < model.valve.triangles.size(); ++k) {
    const Tri &t = model.valve.triangles[k];
    if (!std::all_of(t.begin(), t.end(), is_certain)) continue;
    tissue.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    tissue.leaflet.push_back(model.valve.triangle_leaflet[k]);
  }
  tissue.points.insert(tissue.points.end(), x.begin(), x.end());
}

// The first leaflet of which the surface has little; empty: it has all.
std::string missing_leaflet(const LeafletTriangles &surface, const Model &model,
                            const std::vector<Vec3> &x) {
  const Valve &valve = model.valve;
  std::vector<double> seen(valve.leaflets.size(), 0), whole = seen;  // m2
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    seen[surface.leaflet[t]] += triangle_area(surface.points, surface.triangles[t]);
  }
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    whole[valve.triangle_leaflet[t]] += triangle_area(x, valve.triangles[t]);
  }
  for (size_t k = 0; k < seen.size(); ++k) {
    if (seen[k] < least_of_leaflet * whole[k]) return valve.leaflets[k].name;
  }
  return {};
}

std::string place_of(const OrificePart &part) {
  std::string place = part.anterior;
  if (!part.posterior.empty()) place += (place.empty() ? "" : " to ") + part.posterior;
  return place;
}

// A part of the orifice beside the tissue around it.
struct Surroundings {
  double width = 0;             // m, of the widest ball
  std::vector<double> leaflet;  // m2, of the part nearest to each leaflet

  bool is_between_leaflets() const {
    const double all = std::accumulate(leaflet.begin(), leaflet.end(), 0.0);
    return *std::max_element(leaflet.begin(), leaflet.end()) < (1 - share_of_other) * all;
  }
};

// Balls around the corners and centres of triangles; the leaflet nearest to each centre.
std::vector<Surroundings> surroundings(const Orifice &orifice, const OrificeParts &parts,
                                       const LeafletTriangles &tissue, size_t leaflets) {
  const TriangleBvh tree(tissue.triangles, tissue.points);
  std::vector<Surroundings> found(parts.parts.size(), {0, std::vector<double>(leaflets, 0)});
  const std::vector<Vec3> &x = orifice.vertices;
  for (size_t t = 0; t < orifice.triangles.size(); ++t) {
    const Tri &c = orifice.triangles[t];
    const TriangleBvh::Hit nearest = tree.closest(middle_of(x, c));
    double distance2 = nearest.distance2;
    for (const uint32_t i : c) distance2 = std::max(distance2, tree.closest(x[i]).distance2);
    Surroundings &around = found[parts.of_triangle[t]];
    around.width = std::max(around.width, 2 * std::sqrt(distance2));
    around.leaflet[tissue.leaflet[nearest.triangle]] += triangle_area(x, c);
  }
  return found;
}

// m, the tissue that the surface lacks beside each part: of each leaflet the median along its rim,
// of the leaflets the least; 0 where no rim is near.
std::vector<double> missing_beside(const Orifice &orifice, const OrificeParts &parts,
                                   const LeafletTriangles &surface,
                                   const std::vector<double> &missing, size_t leaflets) {
  const TriangleBvh tree(surface.triangles, surface.points);
  std::vector<size_t> count(parts.parts.size(), 0);
  std::vector<std::vector<double>> along(count.size() * leaflets);
  for (size_t t = 0; t < orifice.triangles.size(); ++t) {
    const uint32_t part = parts.of_triangle[t];
    ++count[part];
    const Vec3 centre = middle_of(orifice.vertices, orifice.triangles[t]);
    const uint32_t nearest = tree.closest(centre).triangle;
    const Tri &beside = surface.triangles[nearest];
    const auto distance2 = [&](uint32_t i) { return (surface.points[i] - centre).squaredNorm(); };
    const uint32_t corner =
        *std::min_element(beside.begin(), beside.end(),
                          [&](uint32_t a, uint32_t b) { return distance2(a) < distance2(b); });
    if (std::isnan(missing[corner])) continue;
    along[part * leaflets + surface.leaflet[nearest]].push_back(missing[corner]);
  }
  std::vector<double> least(count.size(), HUGE_VAL);
  for (size_t k = 0; k < along.size(); ++k) {
    const std::vector<double> &rim = along[k];
    const size_t part = k / leaflets;
    if (rim.empty() ||
        static_cast<double>(rim.size()) < share_of_rim * static_cast<double>(count[part])) {
      continue;
    }
    least[part] = std::min(least[part], median_of(rim));
  }
  for (double &l : least) l = l < HUGE_VAL ? std::max(0.0, l) : 0;
  return least;
}

}  // namespace

// The surface is the middle of the tissue, so that leaflets that touch are a thickness apart.
double least_gap_width(double deviation, double thickness) {
  const double hidden = std::min(usual_thickness, usual_thicknesses * deviation);
  return least_widths * deviation + std::max(0.0, thickness - hidden);
}

bool would_close(const ShownGap &gap) {
  return gap.missing - gap.width >= closed_overlap;
}

ShownGaps shown_gaps(const ClosedSurface &given, const Model &model, const std::vector<Vec3> &x,
                     const PatientGeometry &g, double error) {
  ShownGaps shown;
  shown.error = error;
  const LeafletTriangles surface = tissue_of(given, model, x);
  shown.missing = missing_leaflet(surface, model, x);
  if (!shown.missing.empty()) return shown;
  LeafletTriangles tissue = surface;
  add_certain(model, x, g, tissue);
  const Orifice orifice = cut_orifice_of(tissue.points, tissue.triangles, model, x);
  const OrificeParts found = find_orifice_parts(model, x, RegionMap(model), orifice);
  const std::vector<Surroundings> around =
      surroundings(orifice, found, tissue, model.valve.leaflets.size());
  const std::vector<double> missing =
      missing_beside(orifice, found, surface, missing_reach(surface, annulus_band, model, x, g),
                     model.valve.leaflets.size());
  const EdgeErrors errors(error, median_of(model.valve.triangle_thickness.get()));
  shown.least_width = errors.least_width;
  for (size_t k = 0; k < found.parts.size(); ++k) {
    const OrificePart &part = found.parts[k];
    const double width = around[k].width;
    if (!around[k].is_between_leaflets()) continue;
    if (width < errors.least_width) {
      shown.narrow_area += part.area;
      shown.narrow_width = std::max(shown.narrow_width, width);
      continue;
    }
    shown.gaps.push_back({part.area, width, missing[k], place_of(part)});
    if (would_close(shown.gaps.back())) continue;
    shown.area += part.area;
    shown.least += part.area * std::max(0.0, width - errors.width) / width;
    shown.most += part.area * (width + errors.width) / width;
  }
  if (shown.area < errors.least_area) shown.least = shown.most = 0;
  return shown;
}

}  // namespace mvs::core
