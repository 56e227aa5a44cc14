// Half-edge collapses under the link condition (Dey et al. 1999), and edge flips that improve
// triangle quality.
#include "anatomy/live_sheet.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/sides.h"

namespace mvs::core {
namespace {

// Quality of a triangle with a smallest angle of about 12 degrees; a poorer one may only replace a
// still poorer one.
constexpr double poor = 0.3;
// Cosine of the largest rotation of a triangle normal by a collapse or flip: 60 degrees.
constexpr double turned = 0.5;
// Largest increase of the crease at a flipped edge, in the cosine of the angle between normals.
constexpr double sharper = 0.1;

enum Rim : uint8_t { inside, annulus, free_edge };

Tri with(Tri triangle, uint32_t from, uint32_t to) {
  std::replace(triangle.begin(), triangle.end(), from, to);
  return triangle;
}

bool has(const Tri &triangle, uint32_t vertex) {
  return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

// Returns whether the triangle traverses the edge from a to b.
bool runs(const Tri &t, uint32_t a, uint32_t b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

}  // namespace

LiveSheet::LiveSheet(const Model &model)
    : x_(model.valve.rest),
      scallop_(model.valve.triangle_scallop),
      triangles_(model.valve.triangles),
      star_(model.node_count()),
      scallop_size_(model.valve.scallops.size(), 0),
      rim_(model.node_count(), inside),
      mark_of_(model.node_count(), 0) {
  for (uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const uint32_t corner : triangles_[t]) star_[corner].push_back(t);
    ++scallop_size_[scallop_[t]];
    quality_.push_back(quality(triangles_[t]));
    normal_.push_back(normal(triangles_[t]));
  }
  for (const std::vector<uint32_t> &loop : model.topology.free_edges) {
    for (const uint32_t node : loop) rim_[node] = free_edge;
  }
  for (const uint32_t node : model.valve.annulus) rim_[node] = annulus;
}

double LiveSheet::quality(const Tri &triangle) const {
  const auto &[a, b, c] = triangle;
  const Vec3 ab = x_[b] - x_[a], ac = x_[c] - x_[a];
  const double sum = ab.squaredNorm() + ac.squaredNorm() + (ac - ab).squaredNorm();
  return 2 * std::sqrt(3.0) * ab.cross(ac).norm() / sum;
}

Vec3 LiveSheet::normal(const Tri &triangle) const {
  const Vec3 &a = x_[triangle[0]];
  return (x_[triangle[1]] - a).cross(x_[triangle[2]] - a).normalized();
}

// Returns whether a triangle is over-constrained: all corners on the annulus, or corners on both
// annulus and free edge.
bool LiveSheet::too_stiff(const Tri &triangle) const {
  int on[3] = {0, 0, 0};
  for (const uint32_t corner : triangle) ++on[rim_[corner]];
  return on[annulus] == 3 || (on[annulus] > 0 && on[free_edge] > 0);
}

// A few neighbours: each is put into its place among those before.
void LiveSheet::find_ring(uint32_t vertex, Ring &ring) {
  ring.all.clear();
  ring.along_lines.clear();
  beside_.clear();
  for (const uint32_t t : star_[vertex]) {
    for (const uint32_t corner : triangles_[t]) {
      if (corner == vertex) continue;
      size_t at = ring.all.size();
      while (at > 0 && ring.all[at - 1] > corner) --at;
      if (at > 0 && ring.all[at - 1] == corner) {
        if (beside_[at - 1].scallop == scallop_[t]) beside_[at - 1].triangles = 2;
        continue;
      }
      const auto place = static_cast<std::ptrdiff_t>(at);
      ring.all.insert(ring.all.begin() + place, corner);
      beside_.insert(beside_.begin() + place, {1, scallop_[t]});
    }
  }
  for (size_t k = 0; k < ring.all.size(); ++k) {
    if (beside_[k].triangles == 1) ring.along_lines.push_back(ring.all[k]);
  }
}

LiveSheet::Pair LiveSheet::at_side(uint32_t a, uint32_t b) const {
  Pair pair;
  for (const uint32_t t : star_[a]) {
    if (has(triangles_[t], b)) pair.triangle[pair.count++] = t;
  }
  return pair;
}

bool LiveSheet::joined(uint32_t a, uint32_t b) const {
  return at_side(a, b).count > 0;
}

void LiveSheet::put(uint32_t t, const Tri &triangle) {
  triangles_[t] = triangle;
  quality_[t] = quality(triangle);
  normal_[t] = normal(triangle);
}

// Link condition: the common neighbours of both vertices are exactly those opposite to the side
// between them; then a collapse keeps the topology. A boundary vertex moves along the boundary
// only, see Ring::along_lines.
bool LiveSheet::link_holds(uint32_t gone, const Ring &ring, uint32_t kept) {
  ++mark_;
  for (const uint32_t other : ring.all) mark_of_[other] = mark_;
  uint32_t common = 0;
  for (const uint32_t t : star_[kept]) {
    for (const uint32_t corner : triangles_[t]) {
      if (corner == kept || mark_of_[corner] != mark_) continue;
      ++common;
      mark_of_[corner] = 0;  // counts once
    }
  }
  return common == at_side(gone, kept).count;
}

double LiveSheet::collapse_quality(uint32_t gone, const Ring &ring, uint32_t kept) {
  if (!link_holds(gone, ring, kept)) return -1;
  double worst = 1, worst_before = 1;
  for (const uint32_t t : star_[gone]) {
    const Tri &old = triangles_[t];
    worst_before = std::min(worst_before, quality_[t]);
    if (has(old, kept)) {
      if (scallop_size_[scallop_[t]] <= 2) return -1;
      continue;
    }
    const Tri made = with(old, gone, kept);
    if (too_stiff(made) && !too_stiff(old)) return -1;
    if (normal(made).dot(normal_[t]) < turned) return -1;
    worst = std::min(worst, quality(made));
  }
  return worst < std::min(poor, worst_before) ? -1 : worst;
}

void LiveSheet::drop_from_star(uint32_t vertex, uint32_t triangle) {
  std::erase(star_[vertex], triangle);
}

void LiveSheet::collapse(uint32_t gone, uint32_t kept) {
  for (const uint32_t t : star_[gone]) {
    if (has(triangles_[t], kept)) {
      for (const uint32_t corner : triangles_[t]) {
        if (corner != gone) drop_from_star(corner, t);
      }
      --scallop_size_[scallop_[t]];
      triangles_[t] = {none, none, none};
    } else {
      put(t, with(triangles_[t], gone, kept));
      star_[kept].push_back(t);
    }
  }
  star_[gone].clear();
  std::sort(star_[kept].begin(), star_[kept].end());
}

// Returns whether replacing two triangles by two others is allowed and improves them.
bool LiveSheet::flip_helps(uint32_t t, uint32_t u, const std::array<Tri, 2> &made) const {
  const double before = std::min(quality_[t], quality_[u]);
  // above rounding, so that flips terminate: each raises the worst quality of a pair
  constexpr double gain = 1e-9;
  if (std::min(quality(made[0]), quality(made[1])) <= before + gain) return false;
  const bool stiff = too_stiff(triangles_[t]) || too_stiff(triangles_[u]);
  if (!stiff && (too_stiff(made[0]) || too_stiff(made[1]))) return false;
  const std::array<Vec3, 2> n = {normal_[t], normal_[u]};
  const std::array<Vec3, 2> m = {normal(made[0]), normal(made[1])};
  for (const Vec3 &a : n) {
    for (const Vec3 &b : m) {
      if (a.dot(b) < turned) return false;
    }
  }
  return m[0].dot(m[1]) > n[0].dot(n[1]) - sharper;
}

// Flips the side between two triangles if that improves them; they keep their scallop.
bool LiveSheet::flip(const Edge &side, const Pair &pair) {
  const auto [a, b] = side;
  auto [t, u] = pair.triangle;
  if (scallop_[t] != scallop_[u]) return false;
  if (!runs(triangles_[t], a, b)) std::swap(t, u);
  const uint32_t c = opposite_corner(triangles_[t], {a, b});
  const uint32_t d = opposite_corner(triangles_[u], {a, b});
  const bool too_few = star_[a].size() <= 3 || star_[b].size() <= 3;
  if (too_few || joined(c, d)) return false;
  const std::array<Tri, 2> made = {Tri{a, d, c}, Tri{d, b, c}};
  if (!flip_helps(t, u, made)) return false;
  put(t, made[0]);
  put(u, made[1]);
  drop_from_star(b, t);
  drop_from_star(a, u);
  star_[c].push_back(u);
  star_[d].push_back(t);
  return true;
}

void LiveSheet::flip_around(uint32_t vertex) {
  sides_.clear();
  const auto add_sides = [&](uint32_t t) {
    const auto &[a, b, c] = triangles_[t];
    sides_.insert(sides_.end(), {{a, b}, {b, c}, {c, a}});
  };
  for (const uint32_t t : star_[vertex]) add_sides(t);
  while (!sides_.empty()) {
    const Edge side = sides_.back();
    sides_.pop_back();
    const Pair pair = at_side(side[0], side[1]);
    if (pair.count != 2 || !flip(side, pair)) continue;
    for (const uint32_t t : pair.triangle) add_sides(t);
  }
}

}  // namespace mvs::core
