// Rays, parallel triangles, components.
#include "patient/skin/skin_sides.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "geometry/aabb.h"
#include "geometry/triangle_bvh.h"
#include "model/sides.h"
#include "patient/skin/skin_pieces.h"
#include "patient/skin/thick_parts.h"
#include "patient/surface/manifold.h"

namespace mvs::core {
namespace {

// m: longest rays. Myxomatous leaflets are up to 6 mm thick.
constexpr double longest_ray = 12e-3;
// Cosine of the angle between neighbours beyond which their edge is a ridge between the sides of a
// thin rim.
constexpr double ridge = 0.3;

Vec3 unit_normal(const LeafletSheet &sheet, uint32_t t) {
  const Tri &tri = sheet.triangles[t];
  return (sheet.x[tri[1]] - sheet.x[tri[0]]).cross(sheet.x[tri[2]] - sheet.x[tri[0]]).normalized();
}

// The sides of a skin as components of the triangles with a mark, connected across edges that are
// no ridges.
struct Split {
  std::vector<uint32_t> side_of;  // 0 and 1 for the largest two, others `none`
  std::array<double, 3> area{};   // m2, of the largest three
  double total = 0;               // m2, of all triangles
};

Split largest_components(const LeafletSheet &skin, const std::vector<uint32_t> &smooth,
                         const std::vector<uint8_t> &marks) {
  std::vector<uint32_t> joined = smooth;
  for (uint32_t half_edge = 0; half_edge < joined.size(); ++half_edge) {
    if (joined[half_edge] == none) continue;
    if (marks[half_edge / 3] == 0 || marks[joined[half_edge] / 3] == 0) joined[half_edge] = none;
  }
  Split split;
  std::vector<uint32_t> &piece = split.side_of;
  piece = pieces_of(joined);
  std::vector<double> area;
  for (uint32_t t = 0; t < piece.size(); ++t) {
    if (piece[t] == area.size()) area.push_back(0);
    const double part = triangle_area(skin.x, skin.triangles[t]);
    split.total += part;
    if (marks[t] != 0) area[piece[t]] += part;
  }
  std::vector<uint32_t> order(area.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return area[a] > area[b]; });
  for (size_t k = 0; k < std::min<size_t>(3, order.size()); ++k) split.area[k] = area[order[k]];
  for (uint32_t t = 0; t < piece.size(); ++t) {
    const bool first = piece[t] == order[0], second = order.size() > 1 && piece[t] == order[1];
    piece[t] = marks[t] == 0 || (!first && !second) ? none : (first ? 0 : 1);
  }
  return split;
}

// The two sides. Narrow bridges between them, as noise makes them at a rim, are cut: the marks are
// eroded until two components are left, which then grow back.
std::vector<uint32_t> split_sides(const LeafletSheet &skin, const std::vector<uint32_t> &smooth,
                                  const std::vector<uint8_t> &marks) {
  Split whole;
  std::vector<uint8_t> kept = marks;
  constexpr int most_erosions = 8;
  // least share of the second side in the skin and of the first side, most share of the third part
  constexpr double least_side = 0.15, least_ratio = 0.4, most_other = 0.1;
  for (int erosions = 0; erosions <= most_erosions; ++erosions) {
    Split split = largest_components(skin, smooth, kept);
    if (erosions == 0) whole = split;
    // sides differ by the curvature of a leaflet, and thick rims of short leaflets take up to a
    // third; erosion takes as much again
    if (split.area[1] > least_side * split.total && split.area[1] > least_ratio * split.area[0] &&
        split.area[2] < most_other * split.total) {
      grow_back(smooth, marks, 2 * erosions, split.side_of);
      return split.side_of;
    }
    kept = eroded(smooth, kept);
  }
  fail(MVS_E_OP, "triangles",
       "the skin does not split into two sides: the parts that face parallel tissue have %.0f, "
       "%.0f and %.0f of %.0f mm2; give the mid-surface or the atrial side instead",
       whole.area[0] * 1e6, whole.area[1] * 1e6, whole.area[2] * 1e6, whole.total * 1e6);
}

// Rays from one side must leave through the other one.
void check_facing(const LeafletSheet &skin, const std::vector<TissueBehind> &behind,
                  const std::vector<uint32_t> &side_of) {
  double facing = 0, wrong = 0;
  for (size_t t = 0; t < side_of.size(); ++t) {
    const uint32_t u = behind[t].triangle;
    if (side_of[t] == none || u == none || side_of[u] == none) continue;
    (side_of[u] == side_of[t] ? wrong : facing) += triangle_area(skin.x, skin.triangles[t]);
  }
  // folds that touch make some
  MVS_MUST(wrong <= 0.05 * facing, MVS_E_OP, "triangles",
           "the skin does not split into two sides: behind %.0f of %.0f mm2 lies the same side; "
           "give the mid-surface or the atrial side instead",
           wrong * 1e6, (wrong + facing) * 1e6);
}

// Adds triangles without a side that lie in a side, or in a notch of its rim: two of their
// neighbours belong to it and turn less than 37 degrees from them.
void fill_side_notches(const std::vector<uint32_t> &across, const std::vector<Vec3> &normal,
                       std::vector<uint32_t> &side_of) {
  for (bool grown = true; grown;) {
    grown = false;
    for (uint32_t t = 0; t < side_of.size(); ++t) {
      if (side_of[t] != none) continue;
      std::array<int, 2> beside{};
      for (uint32_t half_edge = 3 * t; half_edge < 3 * t + 3; ++half_edge) {
        const uint32_t u = across[half_edge] == none ? none : across[half_edge] / 3;
        if (u == none || side_of[u] == none || normal[t].dot(normal[u]) < parallel_cosine) continue;
        ++beside[side_of[u]];
      }
      if (beside[0] < 2 && beside[1] < 2) continue;
      side_of[t] = beside[0] >= 2 ? 0 : 1;
      grown = true;
    }
  }
}

// Cosine of the angle between a triangle beside a side and the side: leaflets bend by up to 50
// degrees within their thickness beside the annulus; walls of rims stand at 90.
constexpr double bent = 0.64;

// Adds triangles beside a side that go on in its plane up to a rim. Tissue behind them is not
// parallel: their rays end at the wall of the rim, most of all where triangles are large.
void grow_flat(const LeafletSheet &skin, const std::vector<uint32_t> &across,
               const std::vector<Vec3> &normal, double reach, std::vector<uint32_t> &side_of) {
  const auto centre = [&](uint32_t t) {
    const Tri &tri = skin.triangles[t];
    return Vec3((skin.x[tri[0]] + skin.x[tri[1]] + skin.x[tri[2]]) / 3);
  };
  std::vector<uint32_t> seed(side_of.size());
  std::iota(seed.begin(), seed.end(), 0u);
  for (bool grown = true; grown;) {
    grown = false;
    const std::vector<uint32_t> before = side_of;
    for (uint32_t t = 0; t < side_of.size(); ++t) {
      if (before[t] != none) continue;
      for (uint32_t half_edge = 3 * t; half_edge < 3 * t + 3 && side_of[t] == none; ++half_edge) {
        const uint32_t u = across[half_edge] == none ? none : across[half_edge] / 3;
        if (u == none || before[u] == none) continue;
        // the direction is compared with the side itself, so that it does not creep around a rim
        const uint32_t from = seed[u];
        if (normal[t].dot(normal[u]) < parallel_cosine || normal[t].dot(normal[from]) < bent)
          continue;
        const double size = std::sqrt(triangle_area(skin.x, skin.triangles[t]));
        if ((centre(t) - centre(from)).norm() > reach + 2 * size) continue;
        side_of[t] = before[u];
        seed[t] = from;
        grown = true;
      }
    }
  }
}

}  // namespace

double ray_distance(const Vec3 &from, const Vec3 &way, const Vec3 &a, const Vec3 &b,
                    const Vec3 &c) {
  const Vec3 ab = b - a, ac = c - a, p = way.cross(ac);
  const double det = ab.dot(p);
  if (det == 0) return -1;
  const Vec3 s = from - a, q = s.cross(ab);
  const double u = s.dot(p) / det, v = way.dot(q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 ? ac.dot(q) / det : -1;
}

std::vector<TissueBehind> tissue_behind(const LeafletSheet &skin) {
  const TriangleBvh bvh(skin.triangles, skin.x);
  std::vector<TissueBehind> behind(skin.triangles.size());
  for (uint32_t t = 0; t < behind.size(); ++t) {
    const Tri &tri = skin.triangles[t];
    const Vec3 from = (skin.x[tri[0]] + skin.x[tri[1]] + skin.x[tri[2]]) / 3;
    const Vec3 way = -unit_normal(skin, t);
    // short boxes hold few triangles
    for (const double share : {0.125, 0.25, 0.5, 1.0}) {
      const double length = share * longest_ray;
      if (behind[t].triangle != none) break;
      Aabb box;
      box.add(from);
      box.add(from + length * way);
      double least = length;
      bvh.for_overlapping(box, [&](uint32_t u) {
        if (u == t || unit_normal(skin, u).dot(way) <= 0) return;
        const Tri &other = skin.triangles[u];
        const double distance =
            ray_distance(from, way, skin.x[other[0]], skin.x[other[1]], skin.x[other[2]]);
        if (distance < 0 || distance > least || (distance == least && u > behind[t].triangle)) {
          return;
        }
        least = distance;
        behind[t] = {distance, u};
      });
    }
  }
  return behind;
}

double median_thickness(const std::vector<TissueBehind> &behind) {
  std::vector<double> sorted;
  for (const TissueBehind &b : behind) {
    if (b.triangle != none) sorted.push_back(b.thickness);
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? 0 : sorted[sorted.size() / 2];
}

std::vector<uint32_t> sides_of(const LeafletSheet &skin, const std::vector<TissueBehind> &behind,
                               bool sharp_rims) {
  const size_t n = skin.triangles.size();
  const auto found = static_cast<size_t>(std::count_if(
      behind.begin(), behind.end(), [](const TissueBehind &b) { return b.triangle != none; }));
  MVS_MUST(2 * found > n, MVS_E_OP, "triangles",
           "behind %zu of %zu triangles there is no tissue within %.0f mm: is this the skin of "
           "leaflets?",
           n - found, n, longest_ray * 1e3);
  const double median = median_thickness(behind);
  std::vector<Vec3> normal(n);
  for (uint32_t t = 0; t < n; ++t) normal[t] = unit_normal(skin, t);
  const std::vector<uint8_t> marks = parallel_marks(normal, behind, median);
  const std::vector<uint32_t> across = join_sides(skin.x, skin.triangles).across;
  std::vector<uint32_t> smooth = across;  // without ridges
  for (uint32_t half_edge = 0; half_edge < across.size(); ++half_edge) {
    if (across[half_edge] == none) continue;
    if (normal[half_edge / 3].dot(normal[across[half_edge] / 3]) < ridge) smooth[half_edge] = none;
  }
  std::vector<uint32_t> side_of = split_sides(skin, smooth, marks);
  add_thick_parts({skin, behind, across, normal}, most_side_thickness * median, side_of);
  fill_side_notches(across, normal, side_of);
  if (sharp_rims) grow_flat(skin, across, normal, median, side_of);
  check_facing(skin, behind, side_of);
  return side_of;
}

}  // namespace mvs::core
