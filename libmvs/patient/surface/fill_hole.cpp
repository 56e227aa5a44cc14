// Least-area triangulation, refined and relaxed.
#include "patient/surface/fill_hole.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "model/compressed_rows.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

// Vertices of a loop beyond which its triangulation would take more than about a second.
constexpr size_t most_loop_vertices = 700;
// A side of the filling this much longer than those of the loop is halved: halving at 4/3 makes
// sides of 2/3, so that both are as far from 1 (Botsch & Kobbelt 2004).
constexpr double long_side = 4.0 / 3;
// Share of that side: a vertex so near to the middle of another is in its place.
constexpr double closest_share = 0.1;
// Each round halves the longest sides; 2^40 of them would be too many for any memory.
constexpr int most_rounds = 40;

// The cost of a triangle: its area, and a little of its squared sides, which decides among the
// triangulations of a flat polygon, all of one area.
double cost_of(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double sides2 = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 0.5 * (b - a).cross(c - a).norm() + 0.01 * sides2;
}

Edge sorted_edge(uint32_t a, uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

bool contains_edge(const std::vector<Edge> &sorted, const Edge &edge) {
  return std::binary_search(sorted.begin(), sorted.end(), edge);
}

// The triangulation of a polygon with the least sum of costs, whose diagonals are not edges of the
// sheet already; empty if no triangulation is without such diagonals.
std::vector<Tri> least_triangulation(const std::vector<Vec3> &x,
                                     const std::vector<uint32_t> &polygon,
                                     const std::vector<Edge> &sheet_edges) {
  const size_t n = polygon.size();
  std::vector<double> cost(n * n, 0);
  std::vector<uint32_t> apex(n * n, 0);
  for (size_t span = 2; span < n; ++span) {
    for (size_t i = 0; i + span < n; ++i) {
      const size_t k = i + span;
      double least = INFINITY;
      const bool diagonal = span + 1 < n;
      if (!diagonal || !contains_edge(sheet_edges, sorted_edge(polygon[i], polygon[k]))) {
        for (size_t j = i + 1; j < k; ++j) {
          const double sum = cost[i * n + j] + cost[j * n + k] +
                             cost_of(x[polygon[i]], x[polygon[j]], x[polygon[k]]);
          if (sum >= least) continue;
          least = sum;
          apex[i * n + k] = static_cast<uint32_t>(j);
        }
      }
      cost[i * n + k] = least;
    }
  }
  std::vector<Tri> triangles;
  if (cost[n - 1] == INFINITY) return triangles;
  std::vector<std::pair<size_t, size_t>> open = {{0, n - 1}};
  while (!open.empty()) {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2) continue;
    const size_t j = apex[i * n + k];
    triangles.push_back({polygon[i], polygon[j], polygon[k]});
    open.push_back({i, j});
    open.push_back({j, k});
  }
  return triangles;
}

// Triangles from a polygon to a new vertex in its middle.
std::vector<Tri> fan_triangulation(std::vector<Vec3> &x, const std::vector<uint32_t> &polygon) {
  const uint32_t middle = static_cast<uint32_t>(x.size());
  Vec3 sum = Vec3::Zero();
  std::vector<Tri> triangles;
  for (size_t k = 0; k < polygon.size(); ++k) {
    sum += x[polygon[k]];
    triangles.push_back({polygon[k], polygon[(k + 1) % polygon.size()], middle});
  }
  x.push_back(sum / static_cast<double>(polygon.size()));
  return triangles;
}

// The sides of a patch that lie between two of its triangles.
struct InnerEdge {
  Edge edge;
  std::array<uint32_t, 2> triangle;
};

std::vector<InnerEdge> inner_edges(const std::vector<Tri> &patch) {
  std::vector<InnerEdge> inner;
  const std::vector<Side> sides = sorted_sides(patch);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first == 2) {
      inner.push_back({sides[first].edge, {sides[first].triangle, sides[first + 1].triangle}});
    }
  });
  return inner;
}

// A triangle wound as `like`, with one corner replaced.
Tri with_vertex(Tri like, uint32_t from, uint32_t to) {
  for (uint32_t &i : like) {
    if (i == from) i = to;
  }
  return like;
}

// Claims the two triangles of an edge, unless one of them is claimed.
bool claim(const InnerEdge &e, std::vector<uint8_t> &claimed) {
  const auto [t, u] = e.triangle;
  if (claimed[t] != 0 || claimed[u] != 0) return false;
  claimed[t] = claimed[u] = 1;
  return true;
}

// Whether a corner of the two triangles lies in the middle of their edge: halving it would put
// another vertex there, and in a crumpled patch flips bring the edge back, round after round.
bool has_vertex_in_middle(const std::vector<Vec3> &x, const std::vector<Tri> &patch,
                          const InnerEdge &e, double near) {
  const Vec3 middle = 0.5 * (x[e.edge[0]] + x[e.edge[1]]);
  return std::any_of(e.triangle.begin(), e.triangle.end(), [&](uint32_t t) {
    return (x[opposite_corner(patch[t], e.edge)] - middle).squaredNorm() < near * near;
  });
}

// Halves inner edges that are too long, the longest first, at most one of each triangle; returns
// whether there were any.
bool halve_long(std::vector<Vec3> &x, std::vector<Tri> &patch, double limit) {
  std::vector<std::pair<double, InnerEdge>> found;
  for (const InnerEdge &e : inner_edges(patch)) {
    const double length2 = (x[e.edge[1]] - x[e.edge[0]]).squaredNorm();
    if (length2 > limit * limit && !has_vertex_in_middle(x, patch, e, closest_share * limit)) {
      found.push_back({length2, e});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto &a, const auto &b) { return a.first > b.first; });
  std::vector<uint8_t> claimed(patch.size(), 0);
  for (const auto &[length2, e] : found) {
    if (!claim(e, claimed)) continue;
    const auto [a, b] = e.edge;
    const uint32_t middle = static_cast<uint32_t>(x.size());
    x.push_back(0.5 * (x[a] + x[b]));
    for (const uint32_t t : e.triangle) {
      const Tri whole = patch[t];
      patch[t] = with_vertex(whole, a, middle);
      patch.push_back(with_vertex(whole, b, middle));
    }
  }
  return !found.empty();
}

double angle_cosine(const Vec3 &corner, const Vec3 &a, const Vec3 &b) {
  const double size = std::sqrt((a - corner).squaredNorm() * (b - corner).squaredNorm());
  return size > 0 ? (a - corner).dot(b - corner) / size : 1;
}

// Flips inner edges whose opposite angles sum to more than pi (their cosines to less than zero), at
// most one of each triangle, unless the other diagonal is an edge already; returns whether there
// were any.
bool flip_round(const std::vector<Vec3> &x, std::vector<Tri> &patch,
                const std::vector<Edge> &sheet_edges) {
  const std::vector<InnerEdge> inner = inner_edges(patch);
  std::vector<Edge> patch_edges;
  patch_edges.reserve(inner.size());
  for (const InnerEdge &e : inner) patch_edges.push_back(e.edge);
  std::vector<Edge> made;
  std::vector<uint8_t> claimed(patch.size(), 0);
  for (const InnerEdge &e : inner) {
    const auto [a, b] = e.edge;
    const auto [t, u] = e.triangle;
    if (claimed[t] != 0 || claimed[u] != 0) continue;
    const uint32_t c = opposite_corner(patch[t], e.edge), d = opposite_corner(patch[u], e.edge);
    // far enough below zero that rounding does not flip back and forth
    if (angle_cosine(x[c], x[a], x[b]) + angle_cosine(x[d], x[a], x[b]) > -1e-6) continue;
    const Edge other = sorted_edge(c, d);
    if (contains_edge(sheet_edges, other) || contains_edge(patch_edges, other) ||
        std::find(made.begin(), made.end(), other) != made.end() || !claim(e, claimed)) {
      continue;
    }
    patch[t] = with_vertex(patch[t], b, d);
    patch[u] = with_vertex(patch[u], a, c);
    made.push_back(other);
  }
  return !made.empty();
}

// Moves the vertices from `first` on to the mean of their neighbours, until they rest.
void relax(LeafletSheet &sheet, const std::vector<Tri> &patch, uint32_t first) {
  constexpr int rounds = 100;
  const Rows stars = rows_of(sheet.x.size(), patch);
  for (int round = 0; round < rounds; ++round) {
    for (uint32_t i = first; i < sheet.x.size(); ++i) {
      const std::vector<uint32_t> around = neighbours_in(patch, stars[i], i);
      Vec3 mean = Vec3::Zero();
      double thickness = 0;
      for (const uint32_t j : around) {
        mean += sheet.x[j];
        if (!sheet.thickness.empty()) thickness += sheet.thickness[j];
      }
      sheet.x[i] = mean / static_cast<double>(around.size());
      if (!sheet.thickness.empty()) {
        sheet.thickness[i] = thickness / static_cast<double>(around.size());
      }
    }
  }
}

// The label of the triangle at each side of the loop; none at a side without one, the mouth of a
// notch.
std::vector<std::optional<LeafletLabel>> loop_labels(const LeafletSheet &sheet,
                                                     const std::vector<uint32_t> &loop) {
  const Rows stars = rows_of(sheet.x.size(), sheet.triangles);
  std::vector<std::optional<LeafletLabel>> label(loop.size());
  for (size_t k = 0; k < loop.size(); ++k) {
    const uint32_t to = loop[(k + 1) % loop.size()];
    for (const uint32_t t : stars[loop[k]]) {
      const Tri &tri = sheet.triangles[t];
      if (std::find(tri.begin(), tri.end(), to) != tri.end()) label[k] = sheet.label[t];
    }
  }
  return label;
}

}  // namespace

size_t fill_hole(LeafletSheet &sheet, const std::vector<uint32_t> &loop) {
  const size_t n = loop.size();
  MVS_MUST(n <= most_loop_vertices, MVS_E_OP, "triangles",
           "a hole has %zu vertices, at most %zu are filled: close it, or reduce the surface", n,
           most_loop_vertices);
  double length = 0;
  for (size_t k = 0; k < n; ++k) length += (sheet.x[loop[(k + 1) % n]] - sheet.x[loop[k]]).norm();
  const std::vector<std::optional<LeafletLabel>> label = loop_labels(sheet, loop);
  std::vector<Edge> sheet_edges;
  for (const Side &side : sorted_sides(sheet.triangles)) sheet_edges.push_back(side.edge);
  // the filling passes along the loop the other way
  const std::vector<uint32_t> polygon(loop.rbegin(), loop.rend());
  const uint32_t first = static_cast<uint32_t>(sheet.x.size());
  std::vector<Tri> patch = least_triangulation(sheet.x, polygon, sheet_edges);
  if (patch.empty()) patch = fan_triangulation(sheet.x, polygon);
  const double limit = long_side * length / static_cast<double>(n);
  for (int round = 0; round < most_rounds; ++round) {
    for (int flip = 0; flip < most_rounds && flip_round(sheet.x, patch, sheet_edges); ++flip) {
    }
    if (!halve_long(sheet.x, patch, limit)) break;
  }
  if (!sheet.thickness.empty()) sheet.thickness.resize(sheet.x.size(), 0);
  relax(sheet, patch, first);
  for (const Tri &t : patch) {
    const Vec3 middle = (sheet.x[t[0]] + sheet.x[t[1]] + sheet.x[t[2]]) / 3;
    LeafletLabel nearest = LeafletLabel::unknown;
    double least = INFINITY;
    for (size_t k = 0; k < n; ++k) {
      if (!label[k]) continue;
      const double apart2 =
          (0.5 * (sheet.x[loop[k]] + sheet.x[loop[(k + 1) % n]]) - middle).squaredNorm();
      if (apart2 >= least) continue;
      least = apart2;
      nearest = *label[k];
    }
    sheet.triangles.push_back(t);
    sheet.label.push_back(nearest);
  }
  return patch.size();
}

}  // namespace mvs::core
