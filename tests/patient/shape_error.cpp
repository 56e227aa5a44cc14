// Leaks of shapes that are known to some error, against closed forms.
#include "patient/fit/shape_error.h"

#include <doctest/doctest.h>

#include <cmath>

#include "measure/orifice/orifice.h"
#include "patient/fit/leak_interval.h"
#include "tests/patient/flat_valve.h"
#include "tests/patient/patient_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

constexpr double mm = 1e-3, mm2 = 1e-6;

}  // namespace

TEST_CASE("a_ring_whose_edge_is_farther_in_has_a_larger_hole") {
  const Disc seen(3 * mm);
  CHECK(leak_with_edges_in(*seen.model, seen.x(), seen.g, 0) == about(hole_area(3 * mm), 1e-3));
  for (const double by : {0.5 * mm, 1 * mm, 2.3 * mm}) {
    CAPTURE(by);
    // ways along fibres are exact to 3 % of the height of 13 mm, near the edge to much less; an
    // area errs twice as much as its radius
    CHECK(leak_with_edges_in(*seen.model, seen.x(), seen.g, by) ==
          about(hole_area(3 * mm + by), 0.02));
  }
  // of a low leaflet most remains: the edge moves by at most 0.35 of 0.7 of its height
  CHECK(leak_with_edges_in(*seen.model, seen.x(), seen.g, 1) ==
        about(hole_area(3 * mm + 0.35 * 0.7 * 13 * mm), 0.02));
}

TEST_CASE("a_sealed_valve_leaks_with_its_edge_in_if_little_tissue_seals_it") {
  const Disc seen(0.2 * mm);  // narrower than the contact thickness
  CHECK(leak_with_edges_in(*seen.model, seen.x(), seen.g, 0.05 * mm) == 0);
  CHECK(leak_with_edges_in(*seen.model, seen.x(), seen.g, 1 * mm) ==
        about(hole_area(1.2 * mm), 0.03));
}

TEST_CASE("a_closed_valve_with_a_high_coaptation_seals_with_its_edge_in") {
  const PatientGeometry &g = parametric_geometry(430);
  const ParametricSheet whole = parametric_sheet(430);
  const ClosedPatient closed = close_patient(whole.model->valve);
  REQUIRE(measure_orifice(*closed.model, closed.state.x).area == 0);
  const Coaptation coaptation = measure_coaptation(*closed.model, closed.state.x);
  CHECK(coaptation.length_min > 2 * mm);
  CHECK(leak_with_edges_in(*closed.model, closed.state.x, g, 1 * mm) == 0);
}

TEST_CASE("gaps_are_narrower_by_both_sides_and_close_at_the_contact_thickness") {
  const Disc seen(3 * mm);
  const double whole = hole_area(3 * mm);
  CHECK(leak_of_narrower_gaps(*seen.model, seen.x(), 0) == about(whole, 1e-3));
  // the widest ball in the hole has its diameter; samples of the gap are 0.075 mm apart
  CHECK(leak_of_narrower_gaps(*seen.model, seen.x(), 1 * mm) == about(whole * 2 / 3, 0.02));
  CHECK(leak_of_narrower_gaps(*seen.model, seen.x(), 2.4 * mm) == about(whole * 0.2, 0.08));
  // 0.4 mm are left, less than the contact thickness
  CHECK(leak_of_narrower_gaps(*seen.model, seen.x(), 2.8 * mm) == 0);
}

TEST_CASE("the_distance_of_surfaces_is_that_of_both_ways") {
  const Disc seen(3 * mm);
  ClosedSurface given{seen.x(), seen.g.sheet.triangles};
  CHECK(distance_between(given, *seen.model, seen.x()) == 0);
  for (Vec3 &p : given.points) p.z() += 0.7 * mm;
  CHECK(distance_between(given, *seen.model, seen.x()) == about(0.7 * mm, 1e-9));
  // it does not matter how surfaces are wound
  for (Tri &t : given.triangles) std::swap(t[0], t[1]);
  CHECK(distance_between(given, *seen.model, seen.x()) == about(0.7 * mm, 1e-9));
}

TEST_CASE("the_leaks_of_a_shape_follow_its_distance_from_the_surface") {
  const Disc seen(3 * mm);
  ClosedSurface given{seen.x(), seen.g.sheet.triangles};
  const double whole = hole_area(3 * mm);
  const ShapeLeaks exact = leaks_of_shape(*seen.model, seen.x(), whole, {&given, &seen.g});
  CHECK(exact.least == about(whole, 1e-3));
  CHECK(exact.most == about(whole, 1e-3));
  for (Vec3 &p : given.points) p.z() += 0.5 * mm;
  const ShapeLeaks off = leaks_of_shape(*seen.model, seen.x(), whole, {&given, &seen.g});
  CHECK(off.distance == about(0.5 * mm, 1e-9));
  CHECK(off.error == about(0.98 * mm, 1e-9));  // 95 % of normal deviates
  CHECK(off.least == about(whole * (1 - 0.98 / 3), 0.02));
  CHECK(off.most == about(hole_area(3.98 * mm), 0.02));
}

TEST_CASE("errors_of_shape_and_of_lengths_add_up_in_squares") {
  LeakInterval interval;
  interval.leak = {8 * mm2, 10 * mm2, 12 * mm2};
  interval.least = 7 * mm2, interval.most = 16 * mm2;
  interval.shape = {0.5 * mm, 1 * mm, 6 * mm2, 18 * mm2};
  add_shape_error(interval);
  CHECK(interval.least == about(5 * mm2, 1e-9));  // 3, 4 and 5
  CHECK(interval.most == about(20 * mm2, 1e-9));  // 6, 8 and 10
  // no leak is less than none, and a shape without error changes nothing
  interval.shape = {0.5 * mm, 1 * mm, 0, 10 * mm2};
  add_shape_error(interval);
  CHECK(interval.least == 0);
  CHECK(interval.most == about(20 * mm2, 1e-9));
}
