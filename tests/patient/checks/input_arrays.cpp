// Landmarks and closed leaflets with numbers that are no points of a valve.
#include "patient/checks/input_arrays.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/error.h"
#include "patient/build_valve.h"
#include "tests/patient/parametric_sheet.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

PatientSurface parametric_surface() {
  const ParametricSheet p = parametric_sheet(430);
  PatientSurface surface;
  surface.points = p.sheet.x;
  surface.triangles = p.sheet.triangles;
  surface.closed_points = p.sheet.x;
  surface.closed_triangles = p.sheet.triangles;
  return surface;
}

void refuse(const PatientSurface &surface, const std::string &sentence) {
  CAPTURE(sentence);
  CHECK_THROWS_WITH_AS(build_valve(surface, {}, {}), doctest::Contains(sentence.c_str()), Error);
}

}  // namespace

TEST_CASE("landmarks_that_are_no_numbers_or_beyond_reach_are_refused_by_name_and_row") {
  const PatientSurface fine = parametric_surface();
  const std::pair<std::vector<Vec3> PatientSurface::*, const char *> arrays[] = {
      {&PatientSurface::annulus, "annulus"},
      {&PatientSurface::commissures, "commissures"},
      {&PatientSurface::anterior, "anterior"},
      {&PatientSurface::tips, "papillary_tips"},
      {&PatientSurface::closed_annulus, "closed_annulus"},
      {&PatientSurface::closed_tips, "closed_tips"},
      {&PatientSurface::closed_points, "closed_points"}};
  for (const auto &[array, name] : arrays) {
    for (const double value : {double(NAN), double(INFINITY), -double(INFINITY), 1e300, -1e160}) {
      PatientSurface bad = fine;
      std::vector<Vec3> &points = bad.*array;
      const bool is_list = array != &PatientSurface::closed_points;
      if (is_list) points.assign(array == &PatientSurface::anterior ? 1 : 2, fine.points[5]);
      points.back().y() = value;
      refuse(bad, is_list ? std::string("row ") + (points.size() == 1 ? "0" : "1") + " of " + name
                          : "of closed_points is");
    }
  }
}

TEST_CASE("a_closed_surface_is_checked_as_the_open_one_is") {
  const PatientSurface fine = parametric_surface();
  PatientSurface bad = fine;
  bad.closed_triangles[5][0] = 4294967295;
  refuse(bad, "triangle 5 of closed_triangles has point 4294967295 of");
  bad = fine;
  bad.triangles[5][0] = 4294967295;
  refuse(bad, "triangle 5 of triangles has point 4294967295 of");
  bad = fine;
  bad.closed_points.clear();
  refuse(bad, "closed_points is not");
}

TEST_CASE("two_commissures_and_one_anterior_point_are_accepted") {
  PatientSurface surface = parametric_surface();
  surface.commissures = {surface.points[0]};
  refuse(surface, "commissures has 1 point: a mitral valve has two");
  surface.commissures.assign(3, surface.points[0]);
  refuse(surface, "commissures has 3 points");
  surface.commissures.clear();
  surface.anterior.assign(2, surface.points[0]);
  refuse(surface, "anterior has 2 points: give one point");
  surface.anterior.resize(1);
  CHECK_NOTHROW(check_landmarks(surface));
}
