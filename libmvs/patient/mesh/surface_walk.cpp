// Closest points by descent over neighbouring triangles; boundary loops by arc length.
#include "patient/mesh/surface_walk.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "geometry/distance.h"
#include "model/sides.h"
#include "patient/coordinates.h"

namespace mvs::core {
namespace {

// Sides of triangles within a scale from which on normals are averaged over it: below it a triangle
// shows as much of the shape as the normal there.
constexpr double least_sides = 2;
constexpr int averaging_rounds = 30;  // of averaging: 5 sides far

// A needle: twice its area over the square of its longest side, sin 5 degrees where two sides are
// long. It is wild if its normal is more than 60 degrees off that of a corner, the limit of
// remeshing (sheet_edit.cpp): on a curved sheet the normal of a needle is that of its short side.
constexpr double needle_area = 0.0872, wild_cosine = 0.5;

// The triangle with both vertices on a side; `none` unless exactly one has.
uint32_t only_triangle_at(const std::vector<Tri> &triangles, const Rows &stars, uint32_t a,
                          uint32_t b) {
  uint32_t found = none;
  for (const uint32_t t : stars[a]) {
    const Tri &tri = triangles[t];
    if (std::find(tri.begin(), tri.end(), b) == tri.end()) continue;
    if (found != none) return none;
    found = t;
  }
  return found;
}

bool is_needle(const std::vector<Vec3> &x, const Tri &t, double twice_area) {
  double longest2 = 0;
  for (size_t k = 0; k < 3; ++k) {
    longest2 = std::max(longest2, (x[t[(k + 1) % 3]] - x[t[k]]).squaredNorm());
  }
  return twice_area < needle_area * longest2;
}

// Sums of the area vectors around each vertex, without wild needles; vertices with no other
// triangle get the sum of their neighbours, from ring to ring.
std::vector<Vec3> sums_without_needles(const std::vector<Vec3> &x,
                                       const std::vector<Tri> &triangles) {
  std::vector<Vec3> all = area_normals(x, triangles);
  std::vector<Tri> good;
  for (const Tri &t : triangles) {
    const Vec3 area = area_normal(x, t);
    const double norm = area.norm();
    const bool wild = is_needle(x, t, norm) && std::any_of(t.begin(), t.end(), [&](uint32_t i) {
                        return area.dot(all[i]) <= wild_cosine * norm * all[i].norm();
                      });
    if (!wild) good.push_back(t);
  }
  if (good.size() == triangles.size()) return all;
  std::vector<Vec3> sum = area_normals(x, good);
  bool spreads = true;
  // sums that cancel do not spread for ever
  for (size_t ring = 0; spreads && ring < x.size(); ++ring) {
    spreads = false;
    const std::vector<Vec3> before = sum;
    for (const Tri &t : triangles) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t i = t[k], j = t[(k + 1) % 3], l = t[(k + 2) % 3];
        if (!before[i].isZero(0) || (before[j].isZero(0) && before[l].isZero(0))) continue;
        sum[i] += before[j] + before[l];
        spreads = true;
      }
    }
  }
  return sum;
}

}  // namespace

SurfaceWalk::SurfaceWalk(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                         double scale)
    : x_(x),
      triangles_(triangles),
      stars_(rows_of(x.size(), triangles)),
      normal_(sums_without_needles(x, triangles)) {
  if (scale > 0) average_normals(scale);
  for (Vec3 &n : normal_) {
    const double norm = n.norm();
    if (norm > 0) n /= norm;
  }
}

// Adds the area vectors of the neighbours to those of each vertex, in rounds: a walk of k steps
// goes about sqrt(k) sides far. Folds and needles that are smaller vanish in the sums.
void SurfaceWalk::average_normals(double scale) {
  double sum = 0;
  for (const Tri &t : triangles_) {
    for (size_t k = 0; k < 3; ++k) sum += (x_[t[(k + 1) % 3]] - x_[t[k]]).norm();
  }
  const double sides = scale / (sum / static_cast<double>(3 * triangles_.size()));
  const int rounds = static_cast<int>(std::min(sides * sides, double(averaging_rounds)));
  if (sides < least_sides) return;
  std::vector<Vec3> next(normal_.size());
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < x_.size(); ++i) {
      next[i] = Vec3::Zero();
      for (const uint32_t t : stars_[i]) {
        const auto &[a, b, c] = triangles_[t];
        next[i] += normal_[a] + normal_[b] + normal_[c];
      }
    }
    std::swap(next, normal_);
    for (Vec3 &n : normal_) n /= 18;  // corners around a vertex inside: no overflow
  }
}

Vec3 SurfaceWalk::at(const SurfacePlace &place) const {
  const Tri &t = triangles_[place.triangle];
  return place.weight[0] * x_[t[0]] + place.weight[1] * x_[t[1]] + place.weight[2] * x_[t[2]];
}

Vec3 SurfaceWalk::normal_at(const SurfacePlace &place) const {
  const Tri &t = triangles_[place.triangle];
  const Vec3 sum = place.weight[0] * normal_[t[0]] + place.weight[1] * normal_[t[1]] +
                   place.weight[2] * normal_[t[2]];
  const double norm = sum.norm();
  return norm > 0 ? Vec3(sum / norm) : sum;
}

SurfacePlace SurfaceWalk::closest_from(const SurfacePlace &start, const Vec3 &p) const {
  const auto closest_on = [&](uint32_t t) {
    const Tri &tri = triangles_[t];
    return closest_on_triangle(p, x_[tri[0]], x_[tri[1]], x_[tri[2]]);
  };
  uint32_t at = start.triangle;
  TrianglePoint best = closest_on(at);
  for (bool walks = true; walks && best.feature < 6;) {  // 6: inside the triangle
    walks = false;
    const bool corner = best.feature < 3;
    const Tri &tri = triangles_[at];
    const uint32_t a = tri[best.feature % 3], b = tri[(best.feature + 1) % 3];
    uint32_t next = at;
    for (const uint32_t t : stars_[a]) {
      const Tri &other = triangles_[t];
      if (t == at || (!corner && std::find(other.begin(), other.end(), b) == other.end())) continue;
      const TrianglePoint on = closest_on(t);
      if (on.distance2 >= best.distance2) continue;
      best = on;
      next = t;
      walks = true;
    }
    at = next;
  }
  return {at, best.weight};
}

RimCurve::RimCurve(const LeafletSheet &sheet, const std::vector<uint32_t> &loop, const char *name)
    : line_(points_along(loop, sheet.x)) {
  MVS_MUST(loop.size() >= 3, MVS_E_OP, name, "the %s has %zu vertices, a loop has at least 3", name,
           loop.size());
  const Rows stars = rows_of(sheet.x.size(), sheet.triangles);
  for (size_t k = 0; k < loop.size(); ++k) {
    const uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
    const uint32_t t = only_triangle_at(sheet.triangles, stars, a, b);
    MVS_MUST(t != none, MVS_E_OP, name,
             "vertices %u and %u of the %s are not joined by a side of exactly one triangle: give "
             "it as the boundary loop of the sheet",
             a, b, name);
    const Tri &tri = sheet.triangles[t];
    const auto corner_of = [&](uint32_t vertex) {
      return static_cast<uint32_t>(std::find(tri.begin(), tri.end(), vertex) - tri.begin());
    };
    triangle_.push_back(t);
    corner_.push_back({corner_of(a), corner_of(b)});
  }
  MVS_MUST(length() > 0, MVS_E_OP, name, "the %s has no length", name);
}

SurfacePlace RimCurve::place_at(double s) const {
  const auto [side, share] = line_.locate(s);
  SurfacePlace place{triangle_[side], {}};
  place.weight[corner_[side][0]] = 1 - share;
  place.weight[corner_[side][1]] = share;
  return place;
}

std::vector<double> RimCurve::corners(double reach, double height) const {
  const size_t n = line_.size();
  std::vector<double> out(n), found;
  for (size_t k = 0; k < n; ++k) {
    out[k] = std::sqrt(
        closest_on_segment(line_.corner(k), at(start_of(k) - reach), at(start_of(k) + reach))
            .distance2);
  }
  for (size_t k = 0; k < n; ++k) {
    bool most = out[k] > height;
    for (size_t j = 0; j < n && most; ++j) {
      if (j == k || std::abs(around(start_of(k), start_of(j), length())) > reach) continue;
      most = out[j] < out[k] || (out[j] == out[k] && k < j);
    }
    if (most) found.push_back(start_of(k));
  }
  return found;
}

}  // namespace mvs::core
