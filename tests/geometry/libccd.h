// libccd (Fiser, BSD 3-clause) as a witness: whether two convex bodies meet, and their distance.
//
// libccd has no distance of bodies apart. Two bodies that are inflated by r meet if their distance
// is at most 2 r: bisection in r finds it. GJK decides whether bodies meet in floating point, and
// in doubt says either.
//
// libccd compares with absolute numbers made for lengths around 1: coordinates are multiplied by
// 1024, that is, about millimetres, without rounding. Its defaults are 1e-4 and unbounded
// iterations: here 1e-10 and 1000.
#pragma once

#include <ccd/ccd.h>

#include <cmath>
#include <cstdlib>
#include <span>
#include <vector>

#include "base/types.h"

namespace mvs::core::libccd {

inline constexpr double scale = 1024;        // libccd's lengths per metre
inline constexpr double near_enough = 1e-9;  // m, of a distance: a tenth of the smallest gap in
                                             // contact

inline bool is_long() {
  const char *const asked = std::getenv("MVS_TEST_LONG");
  return asked != nullptr && *asked != 0;
}

inline ccd_vec3_t to_ccd(const Vec3 &v) {
  ccd_vec3_t out;
  ccdVec3Set(&out, scale * v.x(), scale * v.y(), scale * v.z());
  return out;
}

// A convex body: the hull of corners, each of them the centre of a disc normal to `axis`, inflated.
struct Body {
  std::vector<ccd_vec3_t> corner;
  std::vector<double> disc;  // radii, in lengths of libccd; none for points
  ccd_vec3_t axis = {{0, 0, 1}};
  double radius = 0;  // in lengths of libccd
};

inline Body body_of(std::span<const Vec3> points) {
  Body out;
  for (const Vec3 &p : points) out.corner.push_back(to_ccd(p));
  return out;
}

// The part of a direction across the axis of a body's discs, of length 1, and its length before.
inline double across(const Body &body, const ccd_vec3_t &direction, ccd_vec3_t &out) {
  ccdVec3Copy(&out, &body.axis);
  ccdVec3Scale(&out, -ccdVec3Dot(&body.axis, &direction));
  ccdVec3Add(&out, &direction);
  const double length = std::sqrt(ccdVec3Len2(&out));
  if (length > 0) ccdVec3Scale(&out, 1 / length);
  return length;
}

inline void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out) {
  const Body &body = *static_cast<const Body *>(object);
  ccd_vec3_t outwards = {};
  const double wide = body.disc.empty() ? 0 : across(body, *direction, outwards);
  size_t best = 0;
  double most = 0;
  for (size_t k = 0; k < body.corner.size(); ++k) {
    const double disc = wide > 0 ? wide * body.disc[k] : 0;
    const double far = ccdVec3Dot(&body.corner[k], direction) + disc;
    if (k == 0 || far > most) most = far, best = k;
  }
  ccdVec3Copy(out, &body.corner[best]);
  if (wide > 0) {
    ccdVec3Scale(&outwards, body.disc[best]);
    ccdVec3Add(out, &outwards);
  }
  if (body.radius == 0) return;
  ccdVec3Copy(&outwards, direction);
  ccdVec3Scale(&outwards, body.radius / std::sqrt(ccdVec3Len2(direction)));
  ccdVec3Add(out, &outwards);
}

inline bool meet(const Body &a, const Body &b) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = support;
  ccd.max_iterations = 1000;
  ccd.epa_tolerance = ccd.mpr_tolerance = ccd.dist_tolerance = 1e-10;
  return ccdGJKIntersect(&a, &b, &ccd) != 0;
}

// The distance of two bodies up to 1 m apart, m: the smallest inflation of both together at which
// they meet, beyond the radii that they have.
inline double distance(Body a, Body b) {
  const double first = a.radius, second = b.radius;
  double low = 0, high = scale;
  while (high - low > 0.01 * scale * near_enough) {
    const double middle = 0.5 * (low + high);
    a.radius = first + 0.5 * middle;
    b.radius = second + 0.5 * middle;
    (meet(a, b) ? high : low) = middle;
  }
  return high / scale;
}

}  // namespace mvs::core::libccd
