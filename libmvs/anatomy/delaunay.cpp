// Lawson flips with the cotangent criterion on a surface in space.
#include "anatomy/delaunay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "model/sides.h"

namespace mvs::core {
namespace {

constexpr int most_sweeps = 100;  // safety limit, not reached in practice

double cotangent(const Vec3 &at, const Vec3 &b, const Vec3 &c) {
  return (b - at).dot(c - at) / (b - at).cross(c - at).norm();
}

bool is_acute(const Vec3 &at, const Vec3 &b, const Vec3 &c) {
  return (b - at).dot(c - at) > 0;
}

// When triangles changed and when their sides were looked at, so that no side is looked at twice.
struct Times {
  explicit Times(size_t triangles) : changed(triangles, 1), looked(triangles, {0, 0, 0}) {}

  uint32_t now = 1;
  std::vector<uint32_t> changed;
  std::vector<Tri> looked;  // at the side from each corner
};

uint32_t corner_facing(const std::vector<Tri> &across, uint32_t triangle, uint32_t other) {
  const auto &n = across[triangle];
  return static_cast<uint32_t>(std::find(n.begin(), n.end(), other) - n.begin());
}

// Replaces triangles a b c and b a d by a d c and d b c if the edge a b is not Delaunay.
bool flip(HalfSheet &sheet, std::vector<Tri> &across, Times &times, uint32_t t, uint32_t k) {
  const uint32_t u = across[t][k];
  if (u == none || times.looked[t][k] >= std::max(times.changed[t], times.changed[u])) return false;
  const uint32_t a = sheet.triangles[t][k], b = sheet.triangles[t][(k + 1) % 3],
                 c = sheet.triangles[t][(k + 2) % 3];
  const uint32_t j = corner_facing(across, u, t);
  times.looked[t][k] = times.now;
  // the same from the other side as far as the cotangents go; signed areas differ by rounding
  uint32_t &looked_from_there = times.looked[u][j];
  const uint32_t before = std::exchange(looked_from_there, times.now);
  if (on_one_column(sheet, a, b)) return false;
  const uint32_t d = sheet.triangles[u][(j + 2) % 3];
  const auto &x = sheet.x;
  const auto &p = sheet.place;
  // most sides: the sum of two positive cotangents
  if (is_acute(x[c], x[a], x[b]) && is_acute(x[d], x[a], x[b])) return false;
  const double now = cotangent(x[c], x[a], x[b]) + cotangent(x[d], x[a], x[b]);
  if (now > -1e-9) return false;
  const double then = cotangent(x[a], x[c], x[d]) + cotangent(x[b], x[c], x[d]);
  if (then <= now) return false;
  looked_from_there = before;
  if (signed_area(p[a], p[d], p[c]) <= 0 || signed_area(p[d], p[b], p[c]) <= 0) return false;

  const uint32_t over_bc = across[t][(k + 1) % 3], over_ca = across[t][(k + 2) % 3];
  const uint32_t over_ad = across[u][(j + 1) % 3], over_db = across[u][(j + 2) % 3];
  sheet.triangles[t] = {a, d, c};
  sheet.triangles[u] = {d, b, c};
  across[t] = {over_ad, u, over_ca};
  across[u] = {over_db, over_bc, t};
  times.changed[t] = times.changed[u] = ++times.now;
  if (over_ad != none) across[over_ad][corner_facing(across, over_ad, u)] = t;
  if (over_bc != none) across[over_bc][corner_facing(across, over_bc, t)] = u;
  return true;
}

}  // namespace

double signed_area(const Place &a, const Place &b, const Place &c) {
  return (b.v - a.v) * (c.theta - a.theta) - (b.theta - a.theta) * (c.v - a.v);
}

bool on_one_column(const HalfSheet &sheet, uint32_t a, uint32_t b) {
  return (sheet.sides[a] & sheet.sides[b] & on_column) &&
         sheet.place[a].theta == sheet.place[b].theta;
}

std::vector<Tri> connect(const std::vector<Tri> &triangles) {
  const std::vector<Side> sides = sorted_sides(triangles);
  std::vector<Tri> across(triangles.size(), {none, none, none});
  for (size_t i = 1; i < sides.size(); ++i) {
    const Side &p = sides[i - 1], &q = sides[i];
    if (p.edge != q.edge) continue;
    across[p.triangle][p.k] = q.triangle;
    across[q.triangle][q.k] = p.triangle;
  }
  return across;
}

void flip_to_delaunay(HalfSheet &sheet, std::vector<Tri> &across) {
  Times times(sheet.triangles.size());
  bool flipped = true;
  for (int sweep = 0; flipped && sweep < most_sweeps; ++sweep) {
    flipped = false;
    for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
      for (uint32_t k = 0; k < 3; ++k) flipped |= flip(sheet, across, times, t, k);
    }
  }
}

}  // namespace mvs::core
