// Region growing over the flanks of thick parts.
#include "patient/skin/thick_parts.h"

#include "model/sides.h"
#include "patient/surface/manifold.h"
#include "patient/surface/weld.h"

namespace mvs::core {
namespace {

// m: the tissue of myxomatous leaflets is up to 6 mm thick.
constexpr double thickest_part = 8e-3;
// m: the longest flank, from normal tissue to the thickest.
constexpr double longest_flank = 6e-3;
// Cosine of 50 degrees between a flank and the part from which it rises: a rise of a millimetre on
// each side over as much of length makes 45 degrees; walls of rims stand at 90.
constexpr double steepest = 0.64;

// Marks the triangles with thick, parallel tissue behind them in pieces that are as wide as they
// are thick.
std::vector<uint8_t> thick_triangles(const SkinTriangles &s, double least,
                                     const std::vector<uint32_t> &side_of) {
  const size_t n = side_of.size();
  std::vector<uint8_t> marks(n, 0);
  for (size_t t = 0; t < n; ++t) {
    const TissueBehind &b = s.behind[t];
    marks[t] = side_of[t] == none && b.triangle != none && b.thickness > least &&
               b.thickness <= thickest_part &&
               s.normal[t].dot(s.normal[b.triangle]) < -parallel_cosine;
  }
  std::vector<uint32_t> joined = s.across;
  for (uint32_t half_edge = 0; half_edge < joined.size(); ++half_edge) {
    if (joined[half_edge] == none) continue;
    const uint32_t t = half_edge / 3, u = joined[half_edge] / 3;
    const bool smooth = s.normal[t].dot(s.normal[u]) >= parallel_cosine;
    if (marks[t] == 0 || marks[u] == 0 || !smooth) joined[half_edge] = none;
  }
  const std::vector<uint32_t> piece = pieces_of(joined);
  std::vector<double> area(n, 0), volume(n, 0);
  for (size_t t = 0; t < n; ++t) {
    const double part = triangle_area(s.skin.x, s.skin.triangles[t]);
    area[piece[t]] += part;
    volume[piece[t]] += part * s.behind[t].thickness;
  }
  for (size_t t = 0; t < n; ++t) {
    const double all = area[piece[t]], thickness = volume[piece[t]] / all;
    if (marks[t] != 0 && all < thickness * thickness) marks[t] = 0;
  }
  return marks;
}

// A region that grows from the sides, ring by ring.
struct Growth {
  std::vector<uint32_t> side_of;  // of all triangles that it has reached
  std::vector<uint32_t> seed;     // where the flank began that a triangle belongs to
  std::vector<uint32_t> before;   // the triangle from which each was reached
};

Vec3 centre_of(const LeafletSheet &skin, uint32_t t) {
  const Tri &tri = skin.triangles[t];
  return (skin.x[tri[0]] + skin.x[tri[1]] + skin.x[tri[2]]) / 3;
}

bool goes_on(const SkinTriangles &s, uint32_t t, uint32_t u, uint32_t seed) {
  return s.normal[t].dot(s.normal[u]) >= parallel_cosine &&
         s.normal[t].dot(s.normal[seed]) >= steepest &&
         (centre_of(s.skin, t) - centre_of(s.skin, seed)).norm() <= longest_flank;
}

Growth grown_to(const SkinTriangles &s, const std::vector<uint8_t> &thick,
                const std::vector<uint32_t> &side_of) {
  const uint32_t n = static_cast<uint32_t>(side_of.size());
  Growth growth{side_of, std::vector<uint32_t>(n), std::vector<uint32_t>(n, none)};
  std::vector<uint32_t> ring;
  for (uint32_t t = 0; t < n; ++t) {
    growth.seed[t] = t;
    if (side_of[t] != none) ring.push_back(t);
  }
  while (!ring.empty()) {
    std::vector<uint32_t> next;
    for (const uint32_t u : ring) {
      for (uint32_t half_edge = 3 * u; half_edge < 3 * u + 3; ++half_edge) {
        if (s.across[half_edge] == none) continue;
        const uint32_t t = s.across[half_edge] / 3;
        if (growth.side_of[t] != none || !goes_on(s, t, u, growth.seed[u])) continue;
        growth.side_of[t] = growth.side_of[u];
        growth.before[t] = u;
        if (thick[t] == 0) growth.seed[t] = growth.seed[u];
        next.push_back(t);
      }
    }
    ring = std::move(next);
  }
  return growth;
}

}  // namespace

void add_thick_parts(const SkinTriangles &triangles, double least, std::vector<uint32_t> &side_of) {
  const std::vector<uint8_t> thick = thick_triangles(triangles, least, side_of);
  const Growth growth = grown_to(triangles, thick, side_of);
  for (uint32_t t = 0; t < thick.size(); ++t) {
    if (thick[t] == 0 || growth.side_of[t] == none) continue;
    for (uint32_t u = t; u != none && side_of[u] == none; u = growth.before[u]) {
      side_of[u] = growth.side_of[t];
    }
  }
}

}  // namespace mvs::core
