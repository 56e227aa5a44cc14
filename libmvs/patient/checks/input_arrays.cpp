// Finite numbers, lengths within reach, corners that exist, counts of landmarks.
#include "patient/checks/input_arrays.h"

#include "base/error.h"

namespace mvs::core {
namespace {

// m: far beyond valves in any unit, which later checks name, and far below lengths whose squares
// overflow.
constexpr double farthest = 1e6;

bool is_near(const Vec3 &p) {
  return (p.array().abs() <= farthest).all();  // false for NaN
}

void check_points(const std::vector<Vec3> &points, const char *name) {
  for (size_t k = 0; k < points.size(); ++k) {
    const Vec3 &p = points[k];
    MVS_MUST(is_near(p), MVS_E_OP, name,
             "row %zu of %s, counted from 0, is (%g, %g, %g): give finite numbers in m, or leave "
             "the row out",
             k, name, p.x(), p.y(), p.z());
  }
}

}  // namespace

void check_triangles(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                     const char *points_name, const char *triangles_name) {
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (const uint32_t i : triangles[t]) {
      MVS_MUST(i < points.size(), MVS_E_OP, triangles_name,
               "triangle %zu of %s has point %u of %zu: count points from 0", t, triangles_name, i,
               points.size());
      MVS_MUST(
          is_near(points[i]), MVS_E_OP, points_name,
          "point %u of %s is (%g, %g, %g): give finite numbers in m, or leave triangle %zu out", i,
          points_name, points[i].x(), points[i].y(), points[i].z(), t);
    }
  }
}

void check_landmarks(const PatientSurface &surface) {
  check_points(surface.annulus, "annulus");
  check_points(surface.commissures, "commissures");
  check_points(surface.anterior, "anterior");
  check_points(surface.tips, "papillary_tips");
  check_points(surface.closed_annulus, "closed_annulus");
  check_points(surface.closed_tips, "closed_tips");
  MVS_MUST(surface.commissures.empty() || surface.commissures.size() == 2, MVS_E_ARGUMENT,
           "commissures", "commissures has %zu %s: a mitral valve has two; give both, or none",
           surface.commissures.size(), surface.commissures.size() == 1 ? "point" : "points");
  MVS_MUST(surface.anterior.size() <= 1, MVS_E_ARGUMENT, "anterior",
           "anterior has %zu points: give one point of the anterior leaflet, or none",
           surface.anterior.size());
  MVS_MUST(!surface.closed_points.empty() || surface.closed_triangles.empty(), MVS_E_ARGUMENT,
           "closed_triangles",
           "closed_triangles is given and closed_points is not: give the points of the closed "
           "leaflets, or neither");
  check_triangles(surface.closed_points, surface.closed_triangles, "closed_points",
                  "closed_triangles");
  check_points(surface.closed_points, "closed_points");
}

}  // namespace mvs::core
