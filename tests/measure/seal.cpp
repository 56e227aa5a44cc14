// The quick proof that a valve is sealed, against the minimum cut; the lattice it walks on.
#include "measure/orifice/seal.h"

#include <doctest/doctest.h>

#include <cmath>

#include "measure/orifice/orifice.h"
#include "measure/orifice/sheet_lattice.h"
#include "tests/measure/closed_valve.h"

using namespace mvs::core;
using namespace mvs::core::test;

namespace {

Shape close_valve(double annulus_scale) {
  return settled_valve(annulus_scale, 0, MVS_SHAPE_FOUNDING);
}

// Smooth waves of up to `size` m, other ones for each number.
std::vector<Vec3> waved(const std::vector<Vec3> &x, double size, int number) {
  const double n = number, wave = 40 + 40 * (number % 5);
  return moved(x, [&](const Vec3 &p) -> Vec3 {
    const Vec3 q = wave * p;
    return p + size * Vec3(std::sin(q[1] + 1.3 * n), std::sin(q[2] + 2.1 * n),
                           std::sin(q[0] + 0.7 * n));
  });
}

}  // namespace

TEST_CASE("a_valve_proven_to_be_sealed_has_no_minimum_cut") {
  int sealed = 0, open = 0;
  for (const double scale : {1.0, 1.15}) {
    const Shape closed = close_valve(scale);
    for (int k = 0; k < 30; ++k) {
      const std::vector<Vec3> x = waved(closed.x, 0.1e-3 * k, k);
      const bool zipped = orifice::is_zipped(*closed.model, x);
      // the cut is slow: where nothing is proven, of every third shape only
      const bool cut = (zipped || k % 3 == 0) && cut_orifice(*closed.model, x).area > 0;
      CHECK_FALSE((zipped && cut));
      sealed += zipped;
      open += cut;
    }
  }
  CHECK(sealed > 15);
  CHECK(open > 5);
}

TEST_CASE("the_founding_valve_is_proven_to_be_sealed_in_any_position_and_numbering") {
  const Shape closed = close_valve(1);
  CHECK(orifice::is_zipped(*closed.model, closed.x));
  CHECK(orifice::is_zipped(*closed.model, moved(closed.x, some_rigid_motion())));
  const Renumbered other = renumbered(closed.model->valve);
  CHECK(orifice::is_zipped(*other.model, other(closed.x)));
  CHECK_FALSE(orifice::is_zipped(*closed.model, closed.model->valve.rest));
}

// Each of two openings of a valve would need its own proof: the search leaves such a valve to the
// minimum cut, as a double orifice repair makes it.
TEST_CASE("a_sheet_with_a_hole_is_not_proven") {
  Valve valve = valve_of(disc(18e-3, 6e-3, [](double, double) { return 0.0; }));
  CHECK(orifice::is_cylinder(*make_model(valve)));
  const auto removed = static_cast<std::ptrdiff_t>(valve.triangles.size() / 2);
  valve.triangles.edit().erase(valve.triangles.edit().begin() + removed);
  valve.triangle_leaflet.edit().erase(valve.triangle_leaflet.edit().begin() + removed);
  CHECK_FALSE(orifice::is_cylinder(*make_model(valve)));
}

TEST_CASE("steps_on_the_lattice_are_short_and_lead_back") {
  const Shape closed = close_valve(1);
  const orifice::SheetLattice lattice(*closed.model, closed.x, 0.5e-3);
  for (uint32_t v = 0; v < lattice.size(); v += 7) {
    if (closed.model->topology.node_triangles.start.size() > v + 1 &&
        closed.model->topology.node_triangles.start[v] ==
            closed.model->topology.node_triangles.start[v + 1]) {
      continue;  // a papillary head
    }
    size_t steps = 0;
    lattice.for_each_neighbour(v, [&](const orifice::SheetLattice::Step &step) {
      ++steps;
      CHECK((lattice.point(step.to) - lattice.point(v)).norm() < 2e-3);
      bool leads_back = false;
      lattice.for_each_neighbour(step.to, [&](const orifice::SheetLattice::Step &back) {
        leads_back |= back.to == v && back.turns == -step.turns;
      });
      CHECK(leads_back);
    });
    CHECK(steps >= 2);
  }
}
