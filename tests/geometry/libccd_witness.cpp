// libccd (Fiser, BSD 3-clause) as a witness: distances of points and triangles and of two segments,
// and crossings of triangles and segments, against an independent library, on random and degenerate
// pairs. MVS_TEST_LONG=1: a million pairs of each (a minute); otherwise 20,000.
//
// libccd has neither a distance of segments nor one of bodies apart. Two capsules of radius r
// around the segments meet if their distance is at most 2 r: bisection in r finds it. GJK decides
// whether bodies meet in floating point, and in doubt says either. Pairs on which both disagree are
// counted, and a third computation in long double has to explain each:
//
// - point and triangle: ours is wrong for narrow triangles, by 1e-16 of the longest side over the
//   square of height over longest side: 1 nm at a height of 4e-5 of 2 cm, and wholly for triangles
//   that are flat to rounding. model/check_sheet.cpp refuses a height below 1e-6 at rest;
// - two segments: ours takes segments within 1e-6 rad as parallel, and then is at most that times
//   their length too large. GJK with round bodies ends before it has found a slight overlap:
//   libccd's is too large, by at most 10 um;
// - crossings: both agree but for pairs that touch, within 1e-9 m, and ours is exact for these; and
//   some 30 in a million, on the lattice or small, which cross by up to 1 mm (the separating axis
//   test says so) and which libccd finds apart: its GJK ends at a tie.
//
// libccd compares with absolute numbers made for lengths around 1: coordinates are multiplied by
// 1024, that is, about millimetres, without rounding. Its defaults are 1e-4 and unbounded
// iterations: here 1e-10 and 1000.
#include <doctest/doctest.h>

#ifndef MVS_HAS_LIBCCD
TEST_CASE("distances_and_crossings_are_those_of_libccd") {
  MESSAGE("skipped: Debian's libccd-dev is not installed");
}
#else
#include <ccd/ccd.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "geometry/distance.h"
#include "geometry/intersect.h"

using namespace mvs::core;

namespace {

using Triangle = std::array<Vec3, 3>;
using Segment = std::array<Vec3, 2>;

constexpr double scale = 1024;        // libccd's lengths per metre
constexpr double near_enough = 1e-9;  // m, of a distance: a tenth of the smallest gap in contact
// m, of pairs that touch. Rounding of coordinates of 0.1 m moves a corner by 1e-17 m, and the place
// where narrow triangles meet, whose sides are parallel within 1e-5, by up to 1e5 times that for
// each of three factors: 1e-9 m at worst. Seen: 3e-10 m.
constexpr double barely = 1e-9;

bool is_long() {
  const char *const asked = std::getenv("MVS_TEST_LONG");
  return asked != nullptr && *asked != 0;
}
const int pairs = is_long() ? 1000000 : 20000;

ccd_vec3_t to_ccd(const Vec3 &v) {
  ccd_vec3_t out;
  ccdVec3Set(&out, scale * v.x(), scale * v.y(), scale * v.z());
  return out;
}

// A convex body for libccd: hull of some points, inflated.
struct Body {
  std::array<ccd_vec3_t, 3> corner;
  int count = 0;
  double radius = 0;
};

template <size_t N>
Body body_of(const std::array<Vec3, N> &points) {
  Body out;
  out.count = static_cast<int>(N);
  for (size_t k = 0; k < N; ++k) out.corner[k] = to_ccd(points[k]);
  return out;
}

void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out) {
  const Body &body = *static_cast<const Body *>(object);
  int best = 0;
  for (int k = 1; k < body.count; ++k) {
    if (ccdVec3Dot(&body.corner[k], direction) > ccdVec3Dot(&body.corner[best], direction))
      best = k;
  }
  ccdVec3Copy(out, &body.corner[best]);
  if (body.radius == 0) return;
  ccd_vec3_t outwards = *direction;
  ccdVec3Scale(&outwards, body.radius / std::sqrt(ccdVec3Len2(direction)));
  ccdVec3Add(out, &outwards);
}

bool libccd_meets(const Body &a, const Body &b) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.max_iterations = 1000;
  ccd.epa_tolerance = ccd.mpr_tolerance = ccd.dist_tolerance = 1e-10;
  return ccdGJKIntersect(&a, &b, &ccd) != 0;
}

// The distance of two segments, m: the smallest sum of radii at which their capsules meet.
double libccd_distance(const Segment &a, const Segment &b) {
  Body one = body_of(a), other = body_of(b);
  double low = 0, high = scale;  // 1 m
  while (high - low > 0.01 * scale * near_enough) {
    const double middle = 0.5 * (low + high);
    one.radius = other.radius = 0.5 * middle;
    (libccd_meets(one, other) ? high : low) = middle;
  }
  return high / scale;
}

double libccd_distance(const Vec3 &p, const Triangle &t) {
  const ccd_vec3_t point = to_ccd(p), a = to_ccd(t[0]), b = to_ccd(t[1]), c = to_ccd(t[2]);
  return std::sqrt(ccdVec3PointTriDist2(&point, &a, &b, &c, nullptr)) / scale;
}

// The third computation: by all features, in long double.
using Long3 = Eigen::Matrix<long double, 3, 1>;

long double distance2(const Long3 &p, const Long3 &a, const Long3 &b) {
  const Long3 ab = b - a;
  const long double length2 = ab.squaredNorm();
  const long double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0L, 1.0L) : 0.0L;
  return (p - a - s * ab).squaredNorm();
}

double third_distance(const Segment &first, const Segment &second) {
  const Long3 a = first[0].cast<long double>(), b = first[1].cast<long double>();
  const Long3 c = second[0].cast<long double>(), d = second[1].cast<long double>();
  long double least =
      std::min({distance2(a, c, d), distance2(b, c, d), distance2(c, a, b), distance2(d, a, b)});
  const Long3 u = b - a, v = d - c, w = a - c;
  const long double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const long double det = uu * vv - uv * uv;
  if (det > 0) {
    const long double s = (uv * v.dot(w) - vv * u.dot(w)) / det;
    const long double t = (uu * v.dot(w) - uv * u.dot(w)) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
      least = std::min(least, (w + s * u - t * v).squaredNorm());
  }
  return static_cast<double>(std::sqrt(least));
}

double third_distance(const Vec3 &point, const Triangle &t) {
  const Long3 p = point.cast<long double>(), a = t[0].cast<long double>();
  const Long3 b = t[1].cast<long double>(), c = t[2].cast<long double>();
  long double least = std::min({distance2(p, a, b), distance2(p, b, c), distance2(p, c, a)});
  const Long3 u = b - a, v = c - a, w = p - a;
  const long double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm();
  const long double det = uu * vv - uv * uv;
  if (det > 0) {
    const long double s = (vv * u.dot(w) - uv * v.dot(w)) / det;
    const long double r = (uu * v.dot(w) - uv * u.dot(w)) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) least = std::min(least, (w - s * u - r * v).squaredNorm());
  }
  return static_cast<double>(std::sqrt(least));
}

// The distance of two triangles that do not cross.
double third_distance(const Triangle &a, const Triangle &b) {
  double least = third_distance(a[0], b);
  for (size_t k = 0; k < 3; ++k) {
    least = std::min({least, third_distance(a[k], b), third_distance(b[k], a)});
    for (size_t j = 0; j < 3; ++j) {
      least = std::min(
          least, third_distance(Segment{a[k], a[(k + 1) % 3]}, Segment{b[j], b[(j + 1) % 3]}));
    }
  }
  return least;
}

// An upper bound of the depth of two bodies that cross: the least overlap along the axes of the
// separating axis test. 0 for flat contact.
template <size_t N, size_t M>
double depth(const std::array<Vec3, N> &a, const std::array<Vec3, M> &b) {
  double least = 1;
  const auto try_axis = [&](const Vec3 &axis) {
    if (axis.norm() < 1e-12) return;
    std::array<double, 4> range = {1e9, -1e9, 1e9, -1e9};
    for (const Vec3 &p : a) {
      range[0] = std::min(range[0], p.dot(axis.normalized()));
      range[1] = std::max(range[1], p.dot(axis.normalized()));
    }
    for (const Vec3 &p : b) {
      range[2] = std::min(range[2], p.dot(axis.normalized()));
      range[3] = std::max(range[3], p.dot(axis.normalized()));
    }
    least = std::min({least, range[1] - range[2], range[3] - range[0]});
  };
  std::vector<Vec3> sides, normals;
  for (size_t k = 0; k < N; ++k) sides.push_back(a[(k + 1) % N] - a[k]);
  for (size_t k = 0; k < M; ++k) sides.push_back(b[(k + 1) % M] - b[k]);
  for (size_t j = 0; j < sides.size(); ++j) {
    for (size_t k = 0; k < j; ++k) normals.push_back(1e3 * sides[j].cross(sides[k]));
  }
  for (const Vec3 &n : normals) {
    try_axis(n);
    for (const Vec3 &side : sides) try_axis(1e3 * n.cross(side));
  }
  for (const Vec3 &side : sides) try_axis(side);
  return least;
}

// Points around the origin, 1 to 100 mm away, in one of several kinds of position.
class Points {
 public:
  explicit Points(uint64_t seed) : state_(seed) {}
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(bits() >> 33) % n; }
  // Moves on to another kind of pair; all of its points are of that kind.
  void next_pair() {
    kind_ = static_cast<int>(below(8));
    size_ = kind_ == 5 ? 1e-5 : 0.01;
    middle_ = kind_ == 6 ? Vec3(0.07, -0.05, 0.03) : Vec3(0, 0, 0);
    line_ = any();
    made_.clear();
  }
  int kind() const { return kind_; }
  Vec3 point() {
    Vec3 p = middle_ + size_ * any();
    if (kind_ == 1) p = lattice();                           // ties of all sorts
    if (kind_ == 2) p.z() = middle_.z();                     // one plane, exactly
    if (kind_ == 3) p = middle_ + size_ * number() * line_;  // one line, but for rounding
    if (kind_ == 4) p = middle_ + size_ * (number() * line_ + 1e-5 * any());  // needles
    if (kind_ == 7 && made_.size() > 1 && below(2) == 0) p = on_an_edge();
    made_.push_back(p);
    return p;
  }
  template <size_t N>
  std::array<Vec3, N> points() {
    std::array<Vec3, N> out;
    for (Vec3 &p : out) p = point();
    return out;
  }

 private:
  uint64_t bits() {  // xorshift64* (Vigna 2016)
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return state_ * 0x2545F4914F6CDD1D;
  }
  double number() { return static_cast<double>(bits() >> 11) * 0x1p-52 - 1; }
  Vec3 any() {
    const double x = number(), y = number();
    return Vec3(x, y, number());
  }
  Vec3 lattice() {
    const double x = below(5), y = below(5);
    return 0x1p-9 * Vec3(x, y, below(3));
  }
  // A corner of before, or the middle between two: contact at a corner or edge.
  Vec3 on_an_edge() {
    const Vec3 &p = made_[below(static_cast<uint32_t>(made_.size()))];
    const Vec3 &q = made_[below(static_cast<uint32_t>(made_.size()))];
    return 0.5 * (p + q);
  }

  uint64_t state_;
  int kind_ = 0;
  double size_ = 0;
  Vec3 middle_, line_;
  std::vector<Vec3> made_;
};

constexpr const char *kind_names[] = {"random", "lattice", "plane",   "line",
                                      "needle", "small",   "far off", "touching"};

// Pairs on which both disagree, by kind; and those on which one of both is wrong.
struct Disagreements {
  std::array<int, 8> all = {}, ours = {}, libccds = {};
  int unexplained = 0;

  void print(const std::string &what) const {
    int sum = 0;
    for (size_t k = 0; k < all.size(); ++k) {
      sum += all[k];
      if (all[k] == 0) continue;
      MESSAGE(what, ", ", std::string(kind_names[k]), ": ", all[k], " differ, ours wrong in ",
              ours[k], ", libccd in ", libccds[k]);
    }
    MESSAGE(what, ": ", sum, " of ", pairs, " differ, ", unexplained, " unexplained");
  }
};

struct Distances {
  double ours, libccds, third;
};

// The largest errors that are explained: of ours in this pair, and of libccd's, above the true one.
struct Explained {
  double ours, libccds;
};

void take_distance(Disagreements &d, int kind, const Distances &found, const Explained &explained) {
  const auto k = static_cast<size_t>(kind);
  const double our_error = std::abs(found.ours - found.third), more = found.libccds - found.third;
  if (std::abs(found.ours - found.libccds) > near_enough) ++d.all[k];
  if (our_error > near_enough) ++d.ours[k];
  if (std::abs(more) > near_enough) ++d.libccds[k];
  if (our_error > near_enough + explained.ours || more > near_enough + explained.libccds ||
      more < -near_enough)
    ++d.unexplained;
}

double longest_side(const Triangle &t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

// The error of closest_on_triangle() on a narrow triangle, m: its weights are quotients of products
// of four lengths, so that their rounding is divided by the square of height over longest side.
double narrow_error(const Triangle &t) {
  const double longest = longest_side(t);
  const double height = (t[1] - t[0]).cross(t[2] - t[0]).norm() / (longest * longest);
  return longest * std::min(1.0, 1e-16 / (height * height));
}

// closest_of_segments() takes these as parallel.
bool are_parallel(const Segment &a, const Segment &b) {
  const Vec3 u = a[1] - a[0], v = b[1] - b[0];
  return u.cross(v).norm() < 1.01e-6 * u.norm() * v.norm();
}

// Takes crossings on which both disagree. `apart` is the distance of pairs that do not cross,
// `deep` the depth of pairs that do, and negative with a separating axis.
void take_crossing(Disagreements &d, int kind, bool ours, bool theirs,
                   const std::function<double()> &apart, const std::function<double()> &deep) {
  if (ours == theirs) return;
  const auto k = static_cast<size_t>(kind);
  ++d.all[k];
  const double depth = deep();
  if (ours ? std::abs(depth) <= barely : apart() <= barely) return;
  const bool right = ours ? depth > barely : depth < -barely;
  ++(right ? d.libccds : d.ours)[k];
  if (!right) ++d.unexplained;
}

// Ties lead libccd's GJK astray in about 30 of a million pairs.
void check_crossings(const Disagreements &d, int met) {
  CHECK_EQ(d.unexplained, 0);
  int astray = 0;
  for (const int count : d.libccds) astray += count;
  CHECK_LE(astray, std::max(3, pairs / 10000));
  CHECK_GT(met, pairs / 10);
}

}  // namespace

TEST_CASE("distances_of_points_and_triangles_are_those_of_libccd") {
  Points points(11);
  Disagreements d;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto t = points.points<3>();
    const Vec3 p = points.point();
    const double ours = std::sqrt(closest_on_triangle(p, t[0], t[1], t[2]).distance2);
    take_distance(d, points.kind(), {ours, libccd_distance(p, t), third_distance(p, t)},
                  {narrow_error(t), 0});
  }
  d.print("point and triangle");
  CHECK_EQ(d.unexplained, 0);
}

TEST_CASE("distances_of_segments_are_those_at_which_capsules_of_libccd_meet") {
  Points points(12);
  Disagreements d;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto a = points.points<2>(), b = points.points<2>();
    const double ours = std::sqrt(closest_of_segments(a[0], a[1], b[0], b[1]).distance2);
    const double length = std::max((a[1] - a[0]).norm(), (b[1] - b[0]).norm());
    const double parallel = are_parallel(a, b) ? 1e-6 * length : 0;
    take_distance(d, points.kind(), {ours, libccd_distance(a, b), third_distance(a, b)},
                  {parallel, 1e-5});
  }
  d.print("two segments");
  CHECK_EQ(d.unexplained, 0);
}

TEST_CASE("triangles_cross_where_libccd_finds_that_they_meet") {
  Points points(13);
  Disagreements d;
  int met = 0;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto a = points.points<3>(), b = points.points<3>();
    const bool ours = triangles_cross(a, b);
    met += ours ? 1 : 0;
    take_crossing(
        d, points.kind(), ours, libccd_meets(body_of(a), body_of(b)),
        [&] { return third_distance(a, b); }, [&] { return depth(a, b); });
  }
  d.print("two triangles");
  check_crossings(d, met);
}

TEST_CASE("segments_cross_triangles_where_libccd_finds_that_they_meet") {
  Points points(14);
  Disagreements d;
  int met = 0;
  for (int k = 0; k < pairs; ++k) {
    points.next_pair();
    const auto t = points.points<3>();
    const auto s = points.points<2>();
    const bool ours = segment_crosses_triangle(s[0], s[1], t[0], t[1], t[2]);
    met += ours ? 1 : 0;
    const Triangle flat = {s[0], s[1], s[1]};
    take_crossing(
        d, points.kind(), ours, libccd_meets(body_of(s), body_of(t)),
        [&] { return third_distance(flat, t); }, [&] { return depth(s, t); });
  }
  d.print("segment and triangle");
  check_crossings(d, met);
}
#endif
