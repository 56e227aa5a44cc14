// Adaptive predicates (Shewchuk 1997): floating-point filters first, expansions if they are not
// decisive. Pairs of triangles come from a bounding volume hierarchy.
#include "geometry/intersect.h"

#include <algorithm>
#include <cmath>

#include "geometry/bvh.h"
#include "geometry/predicates.h"
#include "geometry/triangle_bvh.h"

namespace mvs::core {
namespace {

// Error bounds of the two determinants below relative to their permanents (Shewchuk 1997,
// equations for ccwerrboundA and o3derrboundA), with epsilon = 2^-53.
constexpr double epsilon = 0x1p-53;
constexpr double orient2d_bound = (3 + 16 * epsilon) * epsilon;
constexpr double orient3d_bound = (7 + 56 * epsilon) * epsilon;

int sign_of(double value) {
  return (value > 0) - (value < 0);
}

// Returns the 2 x 2 determinant of exact differences.
Expansion<16> exact_minor(const Expansion<2> &ax, const Expansion<2> &ay, const Expansion<2> &bx,
                          const Expansion<2> &by) {
  return ax * by + -(ay * bx);
}

int exact_orient3d_sign(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  std::array<std::array<Expansion<2>, 3>, 3> row;
  for (int k = 0; k < 3; ++k) {
    row[0][k] = exact_difference(b[k], a[k]);
    row[1][k] = exact_difference(c[k], a[k]);
    row[2][k] = exact_difference(d[k], a[k]);
  }
  const auto term = [&](int i, int j, int k) {
    return exact_minor(row[0][i], row[0][j], row[1][i], row[1][j]) * row[2][k];
  };
  return (term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1)).sign();
}

// Returns the sign of the area of triangle a b c projected along one axis, exact.
int orient2d_sign(const Vec3 &a, const Vec3 &b, const Vec3 &c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double left = (b[i] - a[i]) * (c[j] - a[j]), right = (b[j] - a[j]) * (c[i] - a[i]);
  const double det = left - right;
  if (std::abs(det) > orient2d_bound * (std::abs(left) + std::abs(right))) return sign_of(det);
  return exact_minor(exact_difference(b[i], a[i]), exact_difference(b[j], a[j]),
                     exact_difference(c[i], a[i]), exact_difference(c[j], a[j]))
      .sign();
}

// Returns whether the projections of two segments along one axis meet: each straddles the line of
// the other, and their boxes overlap, which decides if both are on one line.
bool projected_segments_cross(int axis, const Vec3 &p, const Vec3 &q, const Vec3 &a,
                              const Vec3 &b) {
  for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) {
    if (std::max(p[k], q[k]) < std::min(a[k], b[k])) return false;
    if (std::max(a[k], b[k]) < std::min(p[k], q[k])) return false;
  }
  return orient2d_sign(p, q, a, axis) * orient2d_sign(p, q, b, axis) <= 0 &&
         orient2d_sign(a, b, p, axis) * orient2d_sign(a, b, q, axis) <= 0;
}

// Segments of one plane meet if and only if their projections along all three axes meet: one of
// these projections is injective on the plane.
bool segments_cross(const Vec3 &p, const Vec3 &q, const Vec3 &a, const Vec3 &b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!projected_segments_cross(axis, p, q, a, b)) return false;
  }
  return orient3d_sign(p, q, a, b) == 0;
}

// Returns whether p, in the plane of triangle a b c, is strictly inside it; false for a flat one.
bool strictly_inside(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  for (int axis = 0; axis < 3; ++axis) {
    const int whole = orient2d_sign(a, b, c, axis);
    if (whole == 0) continue;
    return orient2d_sign(a, b, p, axis) == whole && orient2d_sign(b, c, p, axis) == whole &&
           orient2d_sign(c, a, p, axis) == whole;
  }
  return false;
}

// Returns whether all corners of a triangle are strictly on one side of another's plane.
bool is_on_one_side(const std::array<Vec3, 3> &triangle, const std::array<Vec3, 3> &plane) {
  const int first = orient3d_sign(plane[0], plane[1], plane[2], triangle[0]);
  return first != 0 && first == orient3d_sign(plane[0], plane[1], plane[2], triangle[1]) &&
         first == orient3d_sign(plane[0], plane[1], plane[2], triangle[2]);
}

// Returns whether triangles a b c and a b d of one plane are on the same side of their edge.
bool is_folded_flat(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  if (orient3d_sign(a, b, c, d) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const int side = orient2d_sign(a, b, c, axis);
    if (side != 0) return side == orient2d_sign(a, b, d, axis);
  }
  return false;
}

// The plane of a triangle for many points: the sign of orient3d_sign() where its filter decides.
class TrianglePlane {
 public:
  TrianglePlane(const Vec3 &a, const Vec3 &b, const Vec3 &c) : a_(a) {
    const Vec3 u = b - a, v = c - a;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double left = u[i] * v[j], right = u[j] * v[i];
      minor_[k] = left - right;
      permanent_[k] = std::abs(left) + std::abs(right);
    }
  }
  // 0 where the point is on the plane, or rounding might have put it on this side.
  int sure_side_of(const Vec3 &p) const {
    const Vec3 w = p - a_;
    const double det = minor_[2] * w[2] + minor_[0] * w[0] + minor_[1] * w[1];
    const double permanent = permanent_[2] * std::abs(w[2]) + permanent_[0] * std::abs(w[0]) +
                             permanent_[1] * std::abs(w[1]);
    return std::abs(det) > orient3d_bound * permanent ? sign_of(det) : 0;
  }

 private:
  Vec3 a_, minor_, permanent_;
};

// Whether the corners of `other` that it does not share with the triangle of the plane are all
// surely on one side. Then the two do not cross: only the shared corners are in the plane.
bool is_beside(const TrianglePlane &plane, const Tri &of_plane, const Tri &other,
               const std::vector<Vec3> &x) {
  int side = 0;
  for (const uint32_t node : other) {
    if (node == of_plane[0] || node == of_plane[1] || node == of_plane[2]) continue;
    const int of_node = plane.sure_side_of(x[node]);
    if (of_node == 0 || of_node == -side) return false;
    side = of_node;
  }
  return side != 0;
}

// Reorders the corners of both triangles, the shared ones first and in the same order. Returns how
// many are shared.
uint32_t shared_first(Tri &s, Tri &t) {
  uint32_t shared = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    const auto same = std::find(t.begin() + shared, t.end(), s[i]);
    if (same == t.end()) continue;
    std::swap(s[shared], s[i]);
    std::swap(t[shared], *same);
    ++shared;
  }
  return shared;
}

std::vector<Edge> crossing_pairs(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                                 const TriangleBvh &bvh) {
  std::vector<TrianglePlane> plane;
  plane.reserve(triangles.size());
  for (const Tri &t : triangles) plane.emplace_back(x[t[0]], x[t[1]], x[t[2]]);
  std::vector<Edge> crossing;
  bvh.for_near_pairs(0, [&](uint32_t a, uint32_t b) {
    if (!bvh.box_of(a).overlaps(bvh.box_of(b))) return;
    if (is_beside(plane[a], triangles[a], triangles[b], x)) return;
    if (is_beside(plane[b], triangles[b], triangles[a], x)) return;
    const uint32_t s = std::min(a, b), t = std::max(a, b);
    if (triangles_cross(x, triangles[s], triangles[t])) crossing.push_back({s, t});
  });
  std::sort(crossing.begin(), crossing.end());
  return crossing;
}

}  // namespace

int orient3d_sign(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double xy = u.x() * v.y(), yx = u.y() * v.x();
  const double yz = u.y() * v.z(), zy = u.z() * v.y();
  const double zx = u.z() * v.x(), xz = u.x() * v.z();
  const double det = (xy - yx) * w.z() + (yz - zy) * w.x() + (zx - xz) * w.y();
  const double permanent = (std::abs(xy) + std::abs(yx)) * std::abs(w.z()) +
                           (std::abs(yz) + std::abs(zy)) * std::abs(w.x()) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(w.y());
  if (std::abs(det) > orient3d_bound * permanent) return sign_of(det);
  return exact_orient3d_sign(a, b, c, d);
}

bool segment_crosses_triangle(const Vec3 &p, const Vec3 &q, const Vec3 &a, const Vec3 &b,
                              const Vec3 &c) {
  const int side_p = orient3d_sign(a, b, c, p), side_q = orient3d_sign(a, b, c, q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    return segments_cross(p, q, a, b) || segments_cross(p, q, b, c) || segments_cross(p, q, c, a) ||
           strictly_inside(p, a, b, c);
  }
  // the line meets the plane in one point: the sides of the edges on which it passes
  const int ab = orient3d_sign(p, q, a, b), bc = orient3d_sign(p, q, b, c);
  if (ab * bc < 0) return false;
  const int ca = orient3d_sign(p, q, c, a);
  return ab * ca >= 0 && bc * ca >= 0;
}

bool triangles_cross(const std::array<Vec3, 3> &first, const std::array<Vec3, 3> &second) {
  if (is_on_one_side(first, second) || is_on_one_side(second, first)) return false;
  for (int k = 0; k < 3; ++k) {
    const int after = (k + 1) % 3;
    if (segment_crosses_triangle(first[k], first[after], second[0], second[1], second[2]) ||
        segment_crosses_triangle(second[k], second[after], first[0], first[1], first[2])) {
      return true;
    }
  }
  return false;
}

bool triangles_cross(const std::vector<Vec3> &x, const Tri &first, const Tri &second) {
  Tri s = first, t = second;
  const uint32_t shared = shared_first(s, t);
  const std::array<Vec3, 3> a = {x[s[0]], x[s[1]], x[s[2]]}, b = {x[t[0]], x[t[1]], x[t[2]]};
  if (shared == 0) return triangles_cross(a, b);
  if (shared >= 2) return is_folded_flat(a[0], a[1], a[2], b[2]);
  return segment_crosses_triangle(a[1], a[2], b[0], b[1], b[2]) ||
         segment_crosses_triangle(b[1], b[2], a[0], a[1], a[2]);
}

std::vector<Edge> find_intersections(const std::vector<Vec3> &x,
                                     const std::vector<Tri> &triangles) {
  return crossing_pairs(x, triangles, TriangleBvh(triangles, x));
}

std::vector<Edge> find_intersections(const std::vector<Vec3> &x, const std::vector<Tri> &triangles,
                                     const BvhTopology &topology) {
  return crossing_pairs(x, triangles, TriangleBvh(triangles, x, topology));
}

}  // namespace mvs::core
