// Refinement: each triangle becomes four, and every other property of the valve is preserved.
#include "anatomy/refine.h"

#include "tests/about.h"
#include "tests/anatomy/levels.h"

using namespace mvs::core;
using namespace mvs::core::test;

TEST_CASE("a_refined_valve_is_a_valve_of_the_same_topology") {
  for (const Named &one : all_kinds_of_valves()) {
    const ModelPtr &model = one.model;
    CAPTURE(one.name);
    const Valve valve = refine(*model);
    REQUIRE(find_faults(valve).empty());
    const ModelPtr fine = make_model(valve);
    CHECK(counted_vertices(*fine) == counted_vertices(*model) + model->topology.edges.size());
    CHECK(fine->valve.triangles.size() == 4 * model->valve.triangles.size());
    CHECK(euler(*fine) == euler(*model));
    CHECK(fine->topology.free_edges.size() == model->topology.free_edges.size());
    CHECK(fine->valve.annulus.size() == 2 * model->valve.annulus.size());
  }
}

TEST_CASE("refinement_keeps_every_part_and_every_old_vertex") {
  for (const Named &one : all_kinds_of_valves()) {
    const ModelPtr &model = one.model;
    CAPTURE(one.name);
    const Valve &old = model->valve, made = refine(*model);
    CHECK(made.leaflets == old.leaflets);
    CHECK(made.scallops == old.scallops);
    CHECK(made.chords == old.chords);
    CHECK(made.heads == old.heads);
    CHECK(made.rings == old.rings);
    CHECK(made.next_id == old.next_id);
    for (size_t n = 0; n < old.rest.size(); ++n) {
      CHECK(made.rest[n] == old.rest[n]);
      CHECK(made.open[n] == old.open[n]);
      CHECK(made.loaded[n] == old.loaded[n]);
      CHECK(made.origin[n] == old.origin[n]);
    }
    for (size_t n = old.rest.size(); n < made.rest.size(); ++n) CHECK(made.origin[n] == none);
  }
}

TEST_CASE("the_children_of_a_triangle_cover_it_and_have_its_tissue") {
  for (const Named &one : all_kinds_of_valves()) {
    const ModelPtr &model = one.model;
    CAPTURE(one.name);
    const ModelPtr fine = make_model(refine(*model));
    const Valve &old = model->valve, &made = fine->valve;
    for (size_t t = 0; t < old.triangles.size(); ++t) {
      double sum = 0;
      for (size_t child = 4 * t; child < 4 * t + 4; ++child) {
        sum += fine->rest_area[child];
        CHECK(made.triangle_leaflet[child] == old.triangle_leaflet[t]);
        CHECK(made.triangle_scallop[child] == old.triangle_scallop[t]);
        CHECK(made.triangle_thickness[child] == old.triangle_thickness[t]);
        // equal but for the rounding of the plane it lies in: of 40 mm over sides of 0.1 mm, in
        // triangles of 1 degree
        CHECK((made.triangle_fibre[child] - old.triangle_fibre[t]).norm() < 1e-11);
      }
      // rounding of places, as above
      CHECK(sum == about(model->rest_area[t], 1e-11));
    }
    const auto mass = [](const Model &m) {
      return std::accumulate(m.node_mass.begin(), m.node_mass.end(), 0.0);
    };
    CHECK(mass(*fine) == about(mass(*model), 1e-12));
  }
}

TEST_CASE("the_midpoint_of_an_annulus_edge_is_held_between_its_ends") {
  const ModelPtr model = dilated(), fine = make_model(refine(*model));
  const std::vector<uint32_t> &old = model->valve.annulus, &made = fine->valve.annulus;
  for (size_t k = 0; k < old.size(); ++k) {
    const uint32_t a = old[k], b = old[(k + 1) % old.size()], middle = made[2 * k + 1];
    REQUIRE(made[2 * k] == a);
    const Valve &valve = model->valve;
    CHECK(fine->valve.loaded[middle] == 0.5 * (valve.loaded[a] + valve.loaded[b]));
    CHECK(fine->valve.open[middle] == 0.5 * (valve.open[a] + valve.open[b]));
    CHECK(fine->valve.rest[middle] == 0.5 * (valve.rest[a] + valve.rest[b]));
    CHECK(valve.loaded[a] != valve.rest[a]);
  }
}

TEST_CASE("three_refinements_of_the_default_valve_give_a_valve_of_25000_vertices") {
  ModelPtr model = parametric(425);
  const double before = area(*model);
  for (int level = 0; level < 3; ++level) model = make_model(refine(*model));
  CHECK(counted_vertices(*model) > 24000);
  CHECK(euler(*model) == 0);
  // a sum of 50,000 areas
  CHECK(area(*model) == about(before, 1e-12));
  CHECK(crossings(*model) == 0);
}
