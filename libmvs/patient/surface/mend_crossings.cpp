// Rounds of smoothing and pushing in patches around crossings.
#include "patient/surface/mend_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

#include "geometry/intersect.h"
#include "model/compressed_rows.h"
#include "model/sides.h"
#include "patient/coordinates.h"
#include "patient/mesh/surface_walk.h"
#include "patient/surface/crossing_flips.h"

namespace mvs::core {
namespace {

constexpr int most_mend_rounds = 60;
constexpr int rounds_per_ring = 4;  // without fewer crossings, then patches grow by a ring
constexpr int most_rings = 4;
// Rings between two triangles from which on they count as two walls. A vertex that is pushed
// through its own neighbourhood crosses triangles within two.
constexpr int apart_rings = 3;
constexpr int piece_rings = 2;           // of a wall, on which its normal and its side are taken
constexpr double smoothing_share = 0.5;  // share of the way to the mean of the neighbours
constexpr double wall_clearance = 0.02;  // of an edge, by which walls are left apart
constexpr double longest_push = 0.25;    // of an edge, in a round

struct Neighbourhood {
  Rows stars;
  std::vector<std::vector<uint32_t>> around;  // neighbours of each vertex
};

Neighbourhood neighbourhood_of(const LeafletSheet &sheet) {
  Neighbourhood n{rows_of(sheet.x.size(), sheet.triangles), {}};
  for (uint32_t v = 0; v < sheet.x.size(); ++v) {
    n.around.push_back(neighbours_in(sheet.triangles, n.stars[v], v));
  }
  return n;
}

// The vertices within `rings` edges of a triangle, ascending.
std::vector<uint32_t> patch_around(const Neighbourhood &n, const Tri &t, int rings) {
  std::vector<uint32_t> patch(t.begin(), t.end());
  for (int r = 0; r < rings; ++r) {
    const size_t count = patch.size();
    for (size_t k = 0; k < count; ++k) {
      patch.insert(patch.end(), n.around[patch[k]].begin(), n.around[patch[k]].end());
    }
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
  }
  return patch;
}

bool are_two_walls(const Neighbourhood &n, const Tri &s, const Tri &t) {
  const std::vector<uint32_t> patch = patch_around(n, s, apart_rings);
  return std::none_of(t.begin(), t.end(), [&](uint32_t v) {
    return std::find(patch.begin(), patch.end(), v) != patch.end();
  });
}

double mean_side(const LeafletSheet &sheet, const Tri &t) {
  return ((sheet.x[t[0]] - sheet.x[t[1]]).norm() + (sheet.x[t[1]] - sheet.x[t[2]]).norm() +
          (sheet.x[t[2]] - sheet.x[t[0]]).norm()) /
         3;
}

// A vertex on a rim, by its arc length.
struct OnRim {
  const RimCurve *curve = nullptr;
  double arc = 0;
};

// Wanted displacements of vertices: their mean over all crossings that ask for one.
struct WantedMoves {
  std::vector<Vec3> sum;
  std::vector<double> count;
  void add(uint32_t v, const Vec3 &way) {
    sum[v] += way;
    count[v] += 1;
  }
};

// A piece of a wall around a triangle: the mean of its vertices and its area vector.
struct WallPiece {
  Vec3 centre = Vec3::Zero(), area = Vec3::Zero();
};

WallPiece piece_around(const LeafletSheet &sheet, const Neighbourhood &n, const Tri &t) {
  WallPiece piece;
  const std::vector<uint32_t> patch = patch_around(n, t, piece_rings);
  for (const uint32_t v : patch) {
    piece.centre += sheet.x[v] / static_cast<double>(patch.size());
    for (const uint32_t around : n.stars[v]) {
      const auto &[a, b, c] = sheet.triangles[around];
      piece.area += (sheet.x[b] - sheet.x[a]).cross(sheet.x[c] - sheet.x[a]);
    }
  }
  return piece;
}

// Pushes two triangles apart along the normal that both walls have in common, each to the side on
// which most of its wall lies: their corners go as far as a plane half way between the outermost.
void push_apart(const LeafletSheet &sheet, const Neighbourhood &n, const Tri &s, const Tri &t,
                WantedMoves &moves) {
  const WallPiece s_piece = piece_around(sheet, n, s), t_piece = piece_around(sheet, n, t);
  const double same = s_piece.area.dot(t_piece.area) < 0 ? -1.0 : 1.0;
  Vec3 way = s_piece.area + same * t_piece.area;  // the side of s
  const double norm = way.norm();
  if (norm == 0) return;
  way /= (s_piece.centre - t_piece.centre).dot(way) < 0 ? -norm : norm;
  double low = 1e300, high = -1e300;
  for (const uint32_t v : s) low = std::min(low, sheet.x[v].dot(way));
  for (const uint32_t v : t) high = std::max(high, sheet.x[v].dot(way));
  const double edge = std::min(mean_side(sheet, s), mean_side(sheet, t));
  const double middle = 0.5 * (low + high), half = 0.5 * wall_clearance * edge;
  for (const uint32_t v : s) {
    const double depth = middle + half - sheet.x[v].dot(way);
    if (depth > 0) moves.add(v, std::min(depth, longest_push * edge) * way);
  }
  for (const uint32_t v : t) {
    const double depth = sheet.x[v].dot(way) - middle + half;
    if (depth > 0) moves.add(v, -std::min(depth, longest_push * edge) * way);
  }
}

void smooth_patch(const LeafletSheet &sheet, const Neighbourhood &n,
                  const std::vector<uint32_t> &patch, WantedMoves &moves) {
  for (const uint32_t v : patch) {
    if (moves.count[v] > 0) continue;
    Vec3 mean = Vec3::Zero();
    for (const uint32_t w : n.around[v]) mean += sheet.x[w];
    mean /= static_cast<double>(n.around[v].size());
    moves.add(v, smoothing_share * (mean - sheet.x[v]));
  }
}

// Makes the moves: on a rim, their share along it.
void make_moves(LeafletSheet &sheet, const WantedMoves &moves, std::vector<OnRim> &rim) {
  for (size_t v = 0; v < sheet.x.size(); ++v) {
    if (moves.count[v] == 0) continue;
    const Vec3 way = moves.sum[v] / moves.count[v];
    OnRim &on = rim[v];
    if (!on.curve) {
      sheet.x[v] += way;
      continue;
    }
    const double small = 1e-3 * on.curve->length();
    const Vec3 along = on.curve->at(on.arc + small) - on.curve->at(on.arc - small);
    const double norm = along.norm();
    if (norm > 0) on.arc = wrapped(on.arc + way.dot(along) / norm, on.curve->length());
    sheet.x[v] = on.curve->at(on.arc);
  }
}

}  // namespace

CrossingReport mend_crossings(LeafletSheet &sheet, const SheetRims &rims) {
  CrossingReport report;
  std::vector<Edge> pairs = find_intersections(sheet.x, sheet.triangles);
  report.before = report.after = pairs.size();
  if (pairs.empty()) return report;
  const std::vector<Vec3> given = sheet.x;
  pairs = flip_crossings(sheet, std::move(pairs));
  const RimCurve annulus(sheet, rims.annulus, "annulus");
  const RimCurve free_edge(sheet, rims.free_edge, "free edge");
  std::vector<OnRim> rim(sheet.x.size());
  const auto mark = [&](const std::vector<uint32_t> &loop, const RimCurve &curve) {
    for (size_t k = 0; k < loop.size(); ++k) rim[loop[k]] = {&curve, curve.start_of(k)};
  };
  mark(rims.annulus, annulus);
  mark(rims.free_edge, free_edge);
  const Neighbourhood n = neighbourhood_of(sheet);
  std::vector<Vec3> best = sheet.x;
  size_t fewest = pairs.size();
  int stalled = 0;
  for (int round = 0; round < most_mend_rounds && !pairs.empty(); ++round) {
    WantedMoves moves{std::vector<Vec3>(sheet.x.size(), Vec3::Zero()),
                      std::vector<double>(sheet.x.size(), 0)};
    const int rings = std::min(stalled / rounds_per_ring, most_rings);
    std::vector<uint32_t> patch;
    for (const auto &[s, t] : pairs) {
      const Tri &first = sheet.triangles[s], &second = sheet.triangles[t];
      if (are_two_walls(n, first, second)) {
        push_apart(sheet, n, first, second, moves);
        if (rings == 0) continue;
      }
      for (const Tri &tri : {first, second}) {
        const std::vector<uint32_t> more = patch_around(n, tri, rings);
        patch.insert(patch.end(), more.begin(), more.end());
      }
    }
    smooth_patch(sheet, n, patch, moves);
    make_moves(sheet, moves, rim);
    pairs = find_intersections(sheet.x, sheet.triangles);
    ++stalled;
    if (pairs.size() >= fewest) continue;
    fewest = pairs.size();
    best = sheet.x;
    stalled = 0;
  }
  sheet.x = std::move(best);
  report.after = fewest;
  for (size_t v = 0; v < given.size(); ++v) {
    report.largest_move = std::max(report.largest_move, (sheet.x[v] - given[v]).norm());
  }
  return report;
}

}  // namespace mvs::core
