// Isotropic remeshing on a parametric surface (Botsch & Kobbelt 2004).
#include "anatomy/remesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "anatomy/delaunay.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

constexpr int rounds = 8;        // sizes converge in about 6
constexpr int last_rounds = 8;   // of flips and smoothing alone
constexpr int most_passes = 40;  // of splits or collapses in one round: safety limit

// Relative edge lengths: below `low` a collapse, above `high` a split brings an edge nearer to the
// target.
constexpr double low = 4.0 / 5, high = 4.0 / 3;

Place between(const Place &a, const Place &b, double share) {
  return {a.theta + share * (b.theta - a.theta), a.v + share * (b.v - a.v)};
}

// 1 for an equilateral triangle, 0 for a flat one.
double shape_quality(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double sum = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / sum;
}

class Remesher {
 public:
  Remesher(const Shape &shape, double edge, HalfSheet &sheet)
      : shape_(shape), edge_(edge), s_(sheet) {}

  void run() {
    across_ = connect(s_.triangles);
    for (int i = 0; i < rounds; ++i) {
      for (int pass = 0; split_long() && pass < most_passes; ++pass) flip_to_delaunay(s_, across_);
      for (int pass = 0; collapse_short() && pass < most_passes; ++pass)
        flip_to_delaunay(s_, across_);
      flip_to_delaunay(s_, across_);
      smooth();
    }
    for (int i = 0; i < last_rounds; ++i) {
      smooth();
      flip_to_delaunay(s_, across_);
    }
  }

 private:
  double length(uint32_t a, uint32_t b) const { return (s_.x[a] - s_.x[b]).norm(); }

  uint32_t add_vertex(const Place &place, uint8_t sides) {
    s_.place.push_back(place);
    s_.x.push_back(shape_.open(place));
    s_.sides.push_back(sides);
    return static_cast<uint32_t>(s_.x.size() - 1);
  }

  // One pass over the long edges, longest first; a triangle is split at most once in a pass.
  bool split_long() {
    struct Long {
      double length;
      uint32_t triangle, corner;
    };
    std::vector<Long> edges;
    for (uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (uint32_t k = 0; k < 3; ++k) {
        const double l = length(s_.triangles[t][k], s_.triangles[t][(k + 1) % 3]);
        if (l > high * edge_ && (across_[t][k] == none || t < across_[t][k])) {
          edges.push_back({l, t, k});
        }
      }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const Long &p, const Long &q) { return p.length > q.length; });
    std::vector<uint8_t> cut(s_.triangles.size(), 0);
    for (const auto &[l, t, k] : edges) {
      const uint32_t u = across_[t][k];
      if (cut[t] || (u != none && cut[u])) continue;
      cut[t] = 1;
      if (u != none) cut[u] = 1;
      split(t, k);
    }
    if (!edges.empty()) across_ = connect(s_.triangles);
    return !edges.empty();
  }

  void split(uint32_t t, uint32_t k) {
    const uint32_t a = s_.triangles[t][k], b = s_.triangles[t][(k + 1) % 3], u = across_[t][k];
    const bool curve = u == none || on_one_column(s_, a, b);
    const uint8_t sides = curve ? s_.sides[a] & s_.sides[b] : 0;
    const uint32_t middle = add_vertex(between(s_.place[a], s_.place[b], 0.5), sides);
    for (uint32_t triangle : {t, u}) {
      if (triangle == none) continue;
      Tri far = s_.triangles[triangle];
      std::replace(far.begin(), far.end(), a, middle);
      std::replace(s_.triangles[triangle].begin(), s_.triangles[triangle].end(), b, middle);
      s_.triangles.push_back(far);
    }
  }

  // One pass over all edges; collapses of one pass have disjoint neighbourhoods.
  bool collapse_short() {
    ring_ = rows_of(s_.x.size(), s_.triangles);
    std::vector<uint8_t> locked(s_.x.size(), 0);
    bool any = false;
    for (uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t a = s_.triangles[t][k], b = s_.triangles[t][(k + 1) % 3];
        if (a == none || locked[a] || locked[b] || length(a, b) >= low * edge_) continue;
        const bool curve = across_[t][k] == none || on_one_column(s_, a, b);
        if (can_collapse(a, b, curve, locked)) {
          collapse(a, b, locked);
        } else if (can_collapse(b, a, curve, locked)) {
          collapse(b, a, locked);
        } else {
          continue;
        }
        any = true;
      }
    }
    if (any) compact();
    return any;
  }

  // Returns whether vertex a may be merged into b. The cheap conditions come first.
  bool can_collapse(uint32_t a, uint32_t b, bool curve, const std::vector<uint8_t> &locked) const {
    if (s_.sides[a] != 0 && (!curve || s_.sides[a] != (s_.sides[a] & s_.sides[b]))) return false;
    if (is_corner(s_.sides[a])) return false;
    for (uint32_t t : ring_[a]) {
      for (uint32_t i : s_.triangles[t]) {
        if (locked[i] || (i != a && i != b && length(i, b) > high * edge_)) return false;
      }
    }
    size_t shared = 0;
    for (uint32_t t : ring_[a]) {
      Tri triangle = s_.triangles[t];
      if (std::find(triangle.begin(), triangle.end(), b) != triangle.end()) {
        ++shared;
        continue;
      }
      std::replace(triangle.begin(), triangle.end(), a, b);
      if (quality(triangle) < poor) return false;
    }
    const std::vector<uint32_t> around_a = neighbours(a), around_b = neighbours(b);
    std::vector<uint32_t> common;
    std::set_intersection(around_a.begin(), around_a.end(), around_b.begin(), around_b.end(),
                          std::back_inserter(common));
    return common.size() == shared;
  }

  static bool is_corner(uint8_t sides) {
    return (sides & on_column) && (sides & (on_annulus | on_free_edge));
  }

  void collapse(uint32_t a, uint32_t b, std::vector<uint8_t> &locked) {
    for (uint32_t i = ring_.start[a]; i < ring_.start[a + 1]; ++i) {
      Tri &triangle = s_.triangles[ring_.items[i]];
      for (uint32_t corner : triangle) locked[corner] = 1;
      const bool gone = std::find(triangle.begin(), triangle.end(), b) != triangle.end();
      if (gone) {
        triangle = {none, none, none};
      } else {
        std::replace(triangle.begin(), triangle.end(), a, b);
      }
    }
  }

  // The neighbours of a vertex, ascending.
  std::vector<uint32_t> neighbours(uint32_t vertex) const {
    return neighbours_in(s_.triangles, ring_[vertex], vertex);
  }

  // Removes collapsed triangles and unused vertices.
  void compact() {
    std::erase_if(s_.triangles, [](const Tri &t) { return t[0] == none; });
    std::vector<uint32_t> number(s_.x.size(), none);
    for (const Tri &triangle : s_.triangles) {
      for (uint32_t corner : triangle) number[corner] = 0;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < number.size(); ++i) {
      if (number[i] == none) continue;
      s_.place[count] = s_.place[i];
      s_.x[count] = s_.x[i];
      s_.sides[count] = s_.sides[i];
      number[i] = count++;
    }
    s_.place.resize(count);
    s_.x.resize(count);
    s_.sides.resize(count);
    for (Tri &triangle : s_.triangles) {
      for (uint32_t &corner : triangle) corner = number[corner];
    }
    across_ = connect(s_.triangles);
  }

  void smooth() {
    ring_ = rows_of(s_.x.size(), s_.triangles);
    for (uint32_t i = 0; i < s_.x.size(); ++i) {
      if (is_corner(s_.sides[i])) continue;
      move(i, s_.sides[i] == 0 ? centre_of_ring(i) : middle_of_curve(i));
    }
  }

  // Moves a vertex unless that makes a poor triangle.
  void move(uint32_t vertex, const Place &to) {
    const Place old_place = s_.place[vertex];
    const Vec3 old_x = s_.x[vertex];
    s_.place[vertex] = to;
    s_.x[vertex] = shape_.open(to);
    const double after = worst_around(vertex);
    if (after >= good) return;
    const Place new_place = std::exchange(s_.place[vertex], old_place);
    const Vec3 new_x = std::exchange(s_.x[vertex], old_x);
    if (after < worst_around(vertex)) return;
    s_.place[vertex] = new_place;
    s_.x[vertex] = new_x;
  }

  // Area-weighted mean of the centroids of the surrounding triangles: large triangles attract the
  // vertex.
  Place centre_of_ring(uint32_t vertex) const {
    Place sum;
    double weight = 0;
    for (uint32_t i = ring_.start[vertex]; i < ring_.start[vertex + 1]; ++i) {
      const auto &[a, b, c] = s_.triangles[ring_.items[i]];
      const auto &p = s_.place;
      const double area = (s_.x[b] - s_.x[a]).cross(s_.x[c] - s_.x[a]).norm();
      sum.theta += area * (p[a].theta + p[b].theta + p[c].theta) / 3;
      sum.v += area * (p[a].v + p[b].v + p[c].v) / 3;
      weight += area;
    }
    return {sum.theta / weight, sum.v / weight};
  }

  // A vertex on a curve moves towards the farther of its two neighbours on the curve.
  Place middle_of_curve(uint32_t vertex) const {
    const bool column = s_.sides[vertex] & on_column;
    const auto along = [&](uint32_t i) { return column ? s_.place[i].v : s_.place[i].theta; };
    uint32_t before = vertex, after = vertex;
    for (uint32_t i : neighbours(vertex)) {
      const bool same = column ? on_one_column(s_, vertex, i) : s_.sides[vertex] & s_.sides[i];
      if (!same) continue;
      if (along(i) < along(vertex) && (before == vertex || along(i) > along(before))) before = i;
      if (along(i) > along(vertex) && (after == vertex || along(i) < along(after))) after = i;
    }
    const double back = length(vertex, before), ahead = length(vertex, after);
    const double shift = 0.5 * (ahead - back);
    return shift > 0 ? between(s_.place[vertex], s_.place[after], shift / ahead)
                     : between(s_.place[vertex], s_.place[before], -shift / back);
  }

  // Quality of a triangle; negative if it is inverted.
  double quality(const Tri &triangle) const {
    const auto &[a, b, c] = triangle;
    if (signed_area(s_.place[a], s_.place[b], s_.place[c]) <= 0) return -1;
    return shape_quality(s_.x[a], s_.x[b], s_.x[c]);
  }

  double worst_around(uint32_t vertex) const {
    double worst = 1;
    for (uint32_t i = ring_.start[vertex]; i < ring_.start[vertex + 1]; ++i) {
      worst = std::min(worst, quality(s_.triangles[ring_.items[i]]));
    }
    return worst;
  }

  static constexpr double good = 0.75;  // a smallest angle of about 35 degrees
  static constexpr double poor = 0.3;   // of about 12

  const Shape &shape_;
  double edge_;
  HalfSheet &s_;
  std::vector<Tri> across_;
  Rows ring_;
};

}  // namespace

void remesh(const Shape &shape, double edge, HalfSheet &sheet) {
  Remesher(shape, edge, sheet).run();
}

}  // namespace mvs::core
