// The loop of Gilbert, Johnson and Keerthi, with the closest point of a simplex by its faces.
#include "geometry/convex_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/hull_pair.h"

namespace mvs::core {
namespace {

// The loop ends at a corner that it has met, which is after a few turns; the bound is never met in
// tests/geometry.
constexpr int most_turns = 64;
// A gap between bounds of the squared distance, as a share of it, that is rounding.
constexpr double least_progress = 1e-15;
// A triangle of relative height below this is a segment.
constexpr double flat = 1e-12;

// Up to four corners, and the point of their hull closest to the origin.
struct Simplex {
  std::array<HullPair, 4> corner;
  uint32_t count = 0;

  bool has(uint32_t i, uint32_t j) const { return has_pair(std::span(corner).first(count), i, j); }
};

struct Nearest {
  std::array<uint32_t, 3> corner{};
  std::array<double, 3> weight{};
  uint32_t count = 0;
  Vec3 at = Vec3::Zero();
  double distance2 = std::numeric_limits<double>::infinity();

  void take(const Nearest &other) {
    if (other.distance2 < distance2) *this = other;
  }
};

Nearest nearest_of_point(const Simplex &s, uint32_t k) {
  const Vec3 &p = s.corner[k].at;
  return {{k}, {1}, 1, p, p.squaredNorm()};
}

// The inside of an edge; infinitely far if an end is closer.
Nearest nearest_of_edge(const Simplex &s, uint32_t k, uint32_t l) {
  const Vec3 &p = s.corner[k].at, d = s.corner[l].at - p;
  const double along = -p.dot(d), length2 = d.squaredNorm();
  if (!(along > 0 && along < length2)) return {};
  const double t = along / length2;
  const Vec3 at = p + t * d;
  return {{k, l}, {1 - t, t}, 2, at, at.squaredNorm()};
}

// The inside of a face; infinitely far if an edge is closer, or the face is flat.
Nearest nearest_of_face(const Simplex &s, uint32_t k, uint32_t l, uint32_t m) {
  const Vec3 &p = s.corner[k].at, &q = s.corner[l].at, &r = s.corner[m].at;
  const Vec3 u = q - p, v = r - p, n = u.cross(v);
  const double area2 = n.squaredNorm();
  if (!(area2 > flat * flat * u.squaredNorm() * v.squaredNorm())) return {};
  const double a = q.cross(r).dot(n) / area2, b = r.cross(p).dot(n) / area2, c = 1 - a - b;
  if (!(a > 0 && b > 0 && c > 0)) return {};
  const Vec3 at = n.dot(p) / area2 * n;
  return {{k, l, m}, {a, b, c}, 3, at, at.squaredNorm()};
}

bool is_inside_tetrahedron(const Simplex &s) {
  for (uint32_t k = 0; k < 4; ++k) {
    const Vec3 &p = s.corner[(k + 1) % 4].at, &q = s.corner[(k + 2) % 4].at,
               &r = s.corner[(k + 3) % 4].at;
    const Vec3 n = (q - p).cross(r - p);
    const double of_corner = n.dot(s.corner[k].at - p), of_origin = -n.dot(p);
    if (!(of_corner * of_origin > 0)) return false;
  }
  return true;
}

Nearest nearest_of(const Simplex &s) {
  Nearest best;
  for (uint32_t k = 0; k < s.count; ++k) {
    best.take(nearest_of_point(s, k));
    for (uint32_t l = 0; l < k; ++l) {
      best.take(nearest_of_edge(s, l, k));
      for (uint32_t m = 0; m < l; ++m) best.take(nearest_of_face(s, m, l, k));
    }
  }
  return best;
}

void reduce(Simplex &s, const Nearest &nearest) {
  Simplex kept;
  for (uint32_t k = 0; k < nearest.count; ++k)
    kept.corner[kept.count++] = s.corner[nearest.corner[k]];
  s = kept;
}

ConvexDistance result_of(const Simplex &s, const Nearest &nearest) {
  ConvexDistance found;
  found.count = nearest.count;
  for (uint32_t k = 0; k < nearest.count; ++k) {
    found.first[k] = s.corner[k].i;
    found.second[k] = s.corner[k].j;
    found.weight[k] = nearest.weight[k];
  }
  found.apart = nearest.at;
  found.distance = std::sqrt(nearest.distance2);
  return found;
}

}  // namespace

ConvexDistance convex_distance(std::span<const Vec3> a, std::span<const Vec3> b, double cutoff,
                               const HullEdges *edges) {
  Simplex s;
  uint32_t i = edges && !edges->empty() ? edges->first : 0;
  s.corner[s.count++] = {a[i] - b[0], i, 0};
  Nearest nearest = nearest_of_point(s, 0);
  bool are_apart = false;  // a plane has been found between the hulls
  for (int turn = 0; turn < most_turns; ++turn) {
    if (nearest.distance2 == 0) return {};
    i = lowest_corner(edges, a, nearest.at, i);
    const uint32_t j = lowest_point(b, -nearest.at);
    const Vec3 corner = a[i] - b[j];
    const double along = nearest.at.dot(corner);
    are_apart = are_apart || along > 0;
    if (along > 0 && along * along > cutoff * cutoff * nearest.distance2) {
      ConvexDistance found;
      found.apart = nearest.at;
      found.distance = std::sqrt(nearest.distance2);
      found.is_beyond = true;
      return found;
    }
    if (nearest.distance2 - along <= least_progress * nearest.distance2 || s.has(i, j)) break;
    Simplex next = s;
    next.corner[next.count++] = {corner, i, j};
    // rounding may put the origin into a flat tetrahedron, but not past a plane
    if (next.count == 4 && !are_apart && is_inside_tetrahedron(next)) return {};
    const Nearest closer = nearest_of(next);
    if (!(closer.distance2 < nearest.distance2)) break;
    reduce(next, closer);
    s = next;
    nearest = closer;
  }
  return are_apart ? result_of(s, nearest) : ConvexDistance();
}

// A tetrahedron around the origin needs no test of its own: its faces get no closer, or near
// enough.
bool are_apart(std::span<const Vec3> a, std::span<const Vec3> b, double margin, const Vec3 &guess) {
  const double margin2 = margin * margin;
  Simplex s;
  Nearest nearest;  // so far only a direction
  nearest.at = guess;
  for (int turn = 0; turn < most_turns; ++turn) {
    const uint32_t i = lowest_point(a, nearest.at), j = lowest_point(b, -nearest.at);
    const Vec3 corner = a[i] - b[j];
    const double along = nearest.at.dot(corner);
    if (along > 0 && along * along > margin2 * nearest.at.squaredNorm()) return true;
    if (s.has(i, j)) return false;
    s.corner[s.count++] = {corner, i, j};
    const Nearest closer = nearest_of(s);
    if (!(closer.distance2 < nearest.distance2) || closer.distance2 <= margin2) return false;
    reduce(s, closer);
    nearest = closer;
  }
  return false;
}

double plane_gap(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3 &n) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3 &p : a) low = std::min(low, n.dot(p));
  for (const Vec3 &p : b) high = std::max(high, n.dot(p));
  return low - high;
}

}  // namespace mvs::core
