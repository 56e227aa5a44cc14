// Orifice and coaptation of the default valve, closed by the solver.
#include <doctest/doctest.h>
#include <mvs/sim.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "anatomy/parametric.h"
#include "measure/coaptation/coaptation.h"
#include "measure/orifice/orifice.h"
#include "solve/solver.h"
#include "tests/measure/shapes.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

struct Closed {
  ModelPtr model;
  State state;
  bool converged = false;
};

Closed close_valve(double annulus_scale) {
  mvs_parametric_desc desc{};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.annulus_scale = annulus_scale;
  Closed closed;
  closed.model = make_model(make_parametric_valve(desc));
  closed.state = initial_state(*closed.model);
  closed.state.load = {120 * 133.322, 1};
  closed.converged =
      Solver(Backend::fastest).settle(*closed.model, closed.state, {}, nullptr).converged;
  return closed;
}

}  // namespace

TEST_CASE("the_default_valve_is_sealed_at_120_mmhg_and_open_at_rest") {
  const Closed closed = close_valve(1);
  CHECK(closed.converged);
  CHECK(measure_orifice(*closed.model, closed.state.x).area == 0);
  // an open mitral valve has 4 to 6 cm2 in life; here the leaflets hang at rest, half open
  const double open = measure_orifice(*closed.model, closed.model->valve.rest).area;
  CHECK(open > 1.5e-4);
  CHECK(open < 8e-4);
}

TEST_CASE("an_annulus_too_wide_for_its_leaflets_leaks_equally_in_any_position") {
  const Closed closed = close_valve(1.5);
  CHECK(closed.converged);
  const double area = measure_orifice(*closed.model, closed.state.x).area;
  CHECK(area > 10e-6);
  CHECK(area < 300e-6);
  const double moved_area =
      measure_orifice(*closed.model, moved(closed.state.x, some_rigid_motion())).area;
  CHECK(moved_area == about(area, 2e-3));  // rounding may choose other diagonals of the samples
}

// Where a decision of the method flips, the area jumps. A smooth area would rise by the same in all
// steps of a short path, to 1e-4 of the rise; bench_jumps follows more and longer paths.
TEST_CASE("an_orifice_jumps_by_less_than_its_resolution_along_smooth_paths") {
  constexpr double resolution = 1e-3, step = 1e-6;  // of the area (DEFINITIONS.md); m
  const Closed leaking = close_valve(1.5);
  const std::vector<Vec3> closed = leaking.state.x, open = leaking.model->valve.rest;
  for (const std::vector<Vec3> &from : {closed, open}) {
    for (const double turn : {0.0, 1.0}) {
      std::vector<double> areas, rises;
      for (int s = 0; s <= 12; ++s) {
        std::vector<Vec3> x = from;
        for (Vec3 &p : x) {
          const Vec3 q = 350 * p;
          p += s * step * Vec3(std::sin(q[1] + turn), std::sin(q[2]), std::sin(q[0] - turn));
        }
        areas.push_back(cut_orifice(*leaking.model, x).area);
        if (s > 0) rises.push_back(areas[areas.size() - 1] - areas[areas.size() - 2]);
      }
      std::vector<double> sorted = rises;
      std::sort(sorted.begin(), sorted.end());
      const double usual = sorted[sorted.size() / 2];
      for (const double rise : rises) CHECK(std::abs(rise - usual) < resolution * areas[0]);
      // the area is not a constant: the nodes move by 1 um on a rim of some 60 mm
      CHECK(std::abs(areas.back() - areas.front()) > 1e-6 * areas[0]);
    }
  }
}

// The point that a sample faces may lie on an edge. Which of the edge's triangles rounding chooses
// must not matter: it changed the sample's position along the line, and lengths by up to 0.9 %.
TEST_CASE("coaptation_of_a_closed_valve_is_invariant_under_motion_and_renumbering") {
  for (const double scale : {1.0, 1.15}) {
    const Closed closed = close_valve(scale);
    const Coaptation still = measure_coaptation(*closed.model, closed.state.x);
    const auto check_same = [&](const Coaptation &other) {
      constexpr double rounding = 1e-12;  // m; larger than 1e-16 because the line extrapolates
      CHECK(std::abs(other.length_mean - still.length_mean) < rounding);
      CHECK(std::abs(other.length_min - still.length_min) < rounding);
      CHECK(std::abs(other.length_max - still.length_max) < rounding);
    };
    check_same(measure_coaptation(*closed.model, moved(closed.state.x, some_rigid_motion())));
    const Renumbered other = renumbered(closed.model->valve);
    check_same(measure_coaptation(*other.model, other(closed.state.x)));
  }
}
